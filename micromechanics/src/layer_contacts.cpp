#include "suffuse/micromechanics/layer_contacts.h"

#include <algorithm>
#include <cmath>

#include "suffuse/micromechanics/constraint_ratio.h"
#include "suffuse/micromechanics/coordination.h"

namespace suffuse::micromechanics {
namespace {

double share(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

template <std::size_t Size>
void normalise(std::array<double, Size>& counts) {
  double total = 0;
  for (const double count : counts) total += count;
  for (double& count : counts) count = share(count, total);
}

/// Calls `add` with the entry of a layer and with that of all layers.
template <class Add>
void for_layer_and_all(int layer, int layers, Add add) {
  add(static_cast<std::size_t>(layer));
  add(static_cast<std::size_t>(layers));
}

/// Calls `add` with the number of contacts of each grain of a layer (none: of all) of at least this diameter.
template <class Add>
void for_grains_of(const Packing& packing, const HeightLayers& layers, std::optional<int> layer,
                   double least_diameter, Add add) {
  const std::vector<int> counts = contacts_per_grain(packing);
  for (std::size_t g = 0; g < packing.grains.size(); ++g) {
    const Grain& grain = packing.grains[g];
    const auto own = layers.of(grain.position[layers.axis]);
    if (!own || (layer && *own != *layer) || 2 * grain.radius < least_diameter) continue;
    add(counts[g]);
  }
}

/// Calls `take(contact, share, layer)` with each contact within the layers.
template <class Take>
void for_contacts(const Packing& packing, const HeightLayers& layers, Take take) {
  for (const Contact& contact : packing.contacts) {
    const double part = contact_share(packing, contact);
    const auto layer = part > 0 ? layers.of(packing, contact) : std::nullopt;
    if (layer) take(contact, part, *layer);
  }
}

/// Calls `take(contact, share)` with each contact of a layer (none: of all).
template <class Take>
void for_contacts_of(const Packing& packing, const HeightLayers& layers, std::optional<int> layer,
                     Take take) {
  for_contacts(packing, layers, [&](const Contact& contact, double part, int own) {
    if (!layer || own == *layer) take(contact, part);
  });
}

/// How many contacts are strong, and their part of the stress along the axis.
void add_strong_contacts(std::vector<LayerNetwork>& networks, const Packing& packing,
                         const HeightLayers& layers, const std::vector<double>& strong) {
  std::vector<double> stress(networks.size());
  for_contacts(packing, layers, [&](const Contact& contact, double counts, int layer) {
    const double part =
        branch_share(packing, contact) * contact.force[layers.axis] * contact.branch[layers.axis];
    for_layer_and_all(layer, layers.layers, [&](std::size_t k) {
      const double threshold = strong.empty() ? networks[k].mean_normal_force : strong[k];
      const bool is_strong = normal_force(contact) >= threshold;
      networks[k].strong_share += is_strong ? counts : 0;
      networks[k].strong_stress_share += is_strong ? part : 0;
      stress[k] += part;
    });
  });
  for (std::size_t k = 0; k < networks.size(); ++k) {
    networks[k].strong_share = share(networks[k].strong_share, networks[k].contacts);
    networks[k].strong_stress_share = share(networks[k].strong_stress_share, stress[k]);
  }
}

}  // namespace

std::optional<int> HeightLayers::of(double height) const {
  const double from_top = (high - height) / (high - low) * layers;
  if (!(from_top >= 0 && from_top < layers)) return std::nullopt;
  return static_cast<int>(from_top);
}

std::optional<int> HeightLayers::of(const Packing& packing, const Contact& contact) const {
  const Grain& first = packing.grains[static_cast<std::size_t>(contact.first)];
  return of(first.position[axis] - contact.branch[axis] / 2);
}

std::vector<LayerNetwork> layer_networks(const Packing& packing, const HeightLayers& layers,
                                         const SlidingRule& rule, const std::vector<double>& strong) {
  std::vector<LayerNetwork> networks(static_cast<std::size_t>(layers.layers) + 1);
  const std::vector<int> counts = contacts_per_grain(packing);
  for (std::size_t g = 0; g < packing.grains.size(); ++g) {
    const auto layer = layers.of(packing.grains[g].position[layers.axis]);
    if (!layer) continue;
    for_layer_and_all(*layer, layers.layers, [&](std::size_t k) {
      networks[k].grains += 1;
      networks[k].coordination += counts[g];
      networks[k].stable_share += counts[g] >= 4;
    });
  }
  for_contacts(packing, layers, [&](const Contact& contact, double part, int layer) {
    for_layer_and_all(layer, layers.layers, [&](std::size_t k) {
      networks[k].contacts += part;
      networks[k].mean_normal_force += part * normal_force(contact);
      networks[k].sliding_share += is_sliding(contact, rule) ? part : 0;
    });
  });
  for (LayerNetwork& network : networks) {
    network.coordination = share(network.coordination, network.grains);
    network.stable_share = share(network.stable_share, network.grains);
    network.mean_normal_force = share(network.mean_normal_force, network.contacts);
    network.sliding_share = share(network.sliding_share, network.contacts);
    Coordination mean;
    mean.mean = network.coordination;
    network.constraint_ratio = constraint_ratio(mean, network.sliding_share).mean;
  }
  add_strong_contacts(networks, packing, layers, strong);
  return networks;
}

LayerReference::LayerReference(const Packing& packing, const HeightLayers& layers)
    : layers_(layers), contacts_(static_cast<std::size_t>(layers.layers) + 1) {
  for_contacts(packing, layers, [&](const Contact& contact, double, int layer) {
    layer_of_pair_.emplace(pair_of(packing, contact), layer);
    for_layer_and_all(layer, layers.layers, [&](std::size_t k) { contacts_[k] += 1; });
  });
}

std::vector<BrokenContacts> LayerReference::broken(const Packing& packing) const {
  std::vector<BrokenSums> sums(contacts_.size());
  std::multimap<GrainPair, int> unseen = layer_of_pair_;  // a pair may touch through two images
  for (const Contact& contact : packing.contacts) {
    if (!is_counted(packing, contact)) continue;
    if (const auto layer = layers_.of(packing, contact))
      for_layer_and_all(*layer, layers_.layers, [&](std::size_t k) { sums[k].current += 1; });
    const auto reference = unseen.find(pair_of(packing, contact));
    if (reference == unseen.end()) continue;
    for_layer_and_all(reference->second, layers_.layers, [&](std::size_t k) { sums[k].kept += 1; });
    unseen.erase(reference);
  }
  std::vector<BrokenContacts> result;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    sums[k].reference = contacts_[k];
    result.push_back(broken_contacts(sums[k]));
  }
  return result;
}

double own_size_at(const Packing& packing, double finer) {
  std::vector<double> radii;
  double total = 0;
  for (const Grain& grain : packing.grains) {
    radii.push_back(grain.radius);
    total += sphere_volume(grain.radius);
  }
  std::sort(radii.begin(), radii.end());
  double mass = 0;
  for (const double radius : radii) {
    mass += sphere_volume(radius);
    if (mass >= finer * total) return 2 * radius;
  }
  return radii.empty() ? 0 : 2 * radii.back();
}

ContactCounts coordination_distribution(const Packing& packing, const HeightLayers& layers,
                                        std::optional<int> layer, double least_diameter) {
  ContactCounts shares{};
  for_grains_of(packing, layers, layer, least_diameter, [&](int count) {
    shares[std::min(static_cast<std::size_t>(count), shares.size() - 1)] += 1;
  });
  normalise(shares);
  return shares;
}

double mean_coordination(const Packing& packing, const HeightLayers& layers, std::optional<int> layer,
                         double least_diameter) {
  double grains = 0, contacts = 0;
  for_grains_of(packing, layers, layer, least_diameter, [&](int count) {
    grains += 1;
    contacts += count;
  });
  return share(contacts, grains);
}

int median_of(const ContactCounts& shares) {
  double below = 0;
  for (std::size_t count = 0; count < shares.size(); ++count) {
    below += shares[count];
    if (below >= 0.5) return static_cast<int>(count);
  }
  return 0;
}

ForceShares normal_force_distribution(const Packing& packing, const HeightLayers& layers,
                                      std::optional<int> layer, double mean) {
  ForceShares shares{};
  if (!(mean > 0)) return shares;
  for_contacts_of(packing, layers, layer, [&](const Contact& contact, double part) {
    const double bin = std::clamp(normal_force(contact) / mean / kForceBin, 0.0, shares.size() - 1.0);
    shares[static_cast<std::size_t>(bin)] += part;
  });
  normalise(shares);
  return shares;
}

SlippingShares slipping_distribution(const Packing& packing, const HeightLayers& layers,
                                     std::optional<int> layer, const SlidingRule& rule) {
  SlippingShares shares{};
  for_contacts_of(packing, layers, layer, [&](const Contact& contact, double part) {
    const auto bin = static_cast<std::size_t>(std::clamp(10 * slipping_index(contact), 0.0, 9.0));
    shares[is_sliding(contact, rule) ? shares.size() - 1 : bin] += part;
  });
  normalise(shares);
  return shares;
}

}  // namespace suffuse::micromechanics
