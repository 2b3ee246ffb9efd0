#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "suffuse/micromechanics/broken_contacts.h"
#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/slipping.h"

namespace suffuse::micromechanics {

/// Equal layers between two heights, the first on top, as in the thesis. A grain belongs to the layer of its
/// centre, a contact to that of the middle between its two centres.
struct HeightLayers {
  int axis = 2;
  double low = 0, high = 0;  ///< m
  int layers = 1;

  /// 0 on top; none outside.
  std::optional<int> of(double height) const;
  std::optional<int> of(const Packing& packing, const Contact& contact) const;
};

/// The contact network of a layer (thesis section 6.5). All 0 without grains or contacts.
struct LayerNetwork {
  double grains = 0, contacts = 0;
  double coordination = 0;       ///< mean contacts of a grain
  double stable_share = 0;       ///< M_s, share of grains with four contacts or more (eq 6.5)
  double mean_normal_force = 0;  ///< N
  double sliding_share = 0;      ///< S_c
  double strong_share = 0;       ///< contacts with f_N of at least the threshold
  /// Of the stress along the axis, Σ f l over the layer's contacts (eqs 6.3, 6.4), that of the strong ones.
  double strong_stress_share = 0;
  double constraint_ratio = 0;  ///< R = Z(3 − 2 S_c)/12 (eq 6.7)
};

/// One entry a layer, then one for all of them together. `strong`: the thresholds of the entries, N; empty:
/// each entry's own mean. A whole packing with positions.
std::vector<LayerNetwork> layer_networks(const Packing& packing, const HeightLayers& layers,
                                         const SlidingRule& rule, const std::vector<double>& strong);

/// Contacts lost since a reference, by layers: gross is of the reference contacts that were in the layer, net
/// compares the numbers of contacts in the layer then and now. The last entry is of all layers together.
class LayerReference {
 public:
  LayerReference(const Packing& packing, const HeightLayers& layers);

  std::vector<BrokenContacts> broken(const Packing& packing) const;

 private:
  HeightLayers layers_;
  std::multimap<GrainPair, int> layer_of_pair_;
  std::vector<double> contacts_;
};

/// d_xx of spheres of one density: the smallest size such that grains up to it hold the share `finer` (0 to
/// 1) of the mass; one of their own sizes, so that it is the same for grains of a few sizes. m; 0 without
/// grains.
double own_size_at(const Packing& packing, double finer);

/// Shares of grains by their number of contacts: 0, 1, … 11, and 12 or more.
using ContactCounts = std::array<double, 13>;
/// Of the grains of at least this diameter (m) with their centre in a layer (none: all layers). All 0 without
/// such grains.
ContactCounts coordination_distribution(const Packing& packing, const HeightLayers& layers,
                                        std::optional<int> layer, double least_diameter);

/// Mean number of contacts of the same grains; 0 without such grains.
double mean_coordination(const Packing& packing, const HeightLayers& layers, std::optional<int> layer,
                         double least_diameter);

/// The smallest number of contacts that at least half of the grains reach or stay below: the median of a
/// distribution; 0 where all shares are.
int median_of(const ContactCounts& shares);

/// Shares of contacts by f_N/f_0 (thesis Fig. 6.4): bins of 0.25 up to 6, and those above. A share over the
/// bin's width is the probability density.
inline constexpr double kForceBin = 0.25;
using ForceShares = std::array<double, 25>;
/// `mean`: f_0, N, the layer's mean in the reference state. All 0 without contacts or where it is not > 0.
ForceShares normal_force_distribution(const Packing& packing, const HeightLayers& layers,
                                      std::optional<int> layer, double mean);

/// Shares of contacts by their slipping index S_i (eq 6.6): ten bins of 0.1 up to 1, and the sliding ones.
using SlippingShares = std::array<double, 11>;
SlippingShares slipping_distribution(const Packing& packing, const HeightLayers& layers,
                                     std::optional<int> layer, const SlidingRule& rule);

}  // namespace suffuse::micromechanics
