#include "verdict/fluidisation_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "contacts/contact_measures.h"
#include "contacts/snapshot.h"
#include "files/record_table.h"
#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/micromechanics/constraint_ratio.h"
#include "suffuse/micromechanics/layer_contacts.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

constexpr const char* kFluidisationLayers = "fluidisation";

/// A column of the record at a step, straight between samples.
double at_step(const std::vector<double>& steps, const std::vector<double>& values, double step) {
  const auto after = std::lower_bound(steps.begin(), steps.end(), step);
  if (after == steps.begin()) return values.front();
  if (after == steps.end()) return values.back();
  const auto k = static_cast<std::size_t>(after - steps.begin());
  const double share = (step - steps[k - 1]) / (steps[k] - steps[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

/// The states of the record by DEM step.
class StepRecord {
 public:
  StepRecord(const NumberTable& table, const FlowRecord& record)
      : steps_(table.rising_column("dem_step")), times_(table.column("time_s")) {
    const std::size_t layers = record.states.front().gradient.size();
    gradient_.resize(layers + 1);
    stress_.resize(record.states.front().stress.empty() ? 0 : layers);
    for (const FlowState& state : record.states) {
      for (std::size_t k = 0; k < layers; ++k) gradient_[k].push_back(state.gradient[k]);
      gradient_[layers].push_back(bed_gradient(state.gradient));
      for (std::size_t k = 0; k < stress_.size(); ++k)
        stress_[k].push_back(state.stress[k] / record.states.front().stress[k]);
    }
  }

  /// The step of the grains at this snapshot. A file of the coupled run counts the fluid's steps, but has the
  /// time of the record.
  double step_of(const Snapshot& snapshot) const {
    return snapshot.time ? at_step(times_, steps_, *snapshot.time) : static_cast<double>(snapshot.step);
  }
  /// Is it within the record, or an interval of it?
  bool covers(const Snapshot& snapshot) const {
    if (!snapshot.time) return covers(static_cast<double>(snapshot.step));
    const double margin =
        times_.size() > 1 ? (times_.back() - times_.front()) / static_cast<double>(times_.size() - 1) : 0;
    return *snapshot.time >= times_.front() - margin && *snapshot.time <= times_.back() + margin;
  }
  /// Within an interval of the samples.
  bool covers(double step) const {
    const double margin =
        steps_.size() > 1 ? (steps_.back() - steps_.front()) / static_cast<double>(steps_.size() - 1) : 0;
    return step >= steps_.front() - margin && step <= steps_.back() + margin;
  }
  double time(double step) const { return at_step(steps_, times_, step); }
  /// Of a layer, or with the number of layers of the bed.
  double gradient(std::size_t layer, double step) const { return at_step(steps_, gradient_[layer], step); }
  std::optional<double> stress_ratio(std::size_t layer, double step) const {
    if (layer >= stress_.size()) return std::nullopt;
    const double ratio = at_step(steps_, stress_[layer], step);
    return std::isfinite(ratio) ? std::optional(ratio) : std::nullopt;  // of a layer without stress at rest
  }

 private:
  const std::vector<double>&steps_, &times_;
  std::vector<std::vector<double>> gradient_, stress_;
};

HeightLayers layers_of(const LayerOptions& options, const NumberTable& table, const FlowRecord& record) {
  HeightLayers layers;
  layers.axis = record.axis - 'x';
  layers.layers = static_cast<int>(record.states.front().gradient.size());
  if (options.bounds.empty()) {
    const auto* height = table.find("layers_height_m");
    if (!height)
      throw_user_error({kFluidisationLayers, table.path(), "no column layers_height_m", "have it",
                        "or give --bounds LOW HIGH"});
    const auto* top = table.find("layers_top_m");
    layers.high = (top ? top : height)->front();
    if (const auto* floor = table.find("layers_floor_m")) layers.low = floor->front();
  } else {
    layers.low = options.bounds[0];
    layers.high = options.bounds[1];
  }
  if (!(layers.high > layers.low))
    throw_user_error({kFluidisationLayers, "--bounds", fmt::format("{:g} {:g}", layers.low, layers.high),
                      "be LOW HIGH, LOW < HIGH", ""});
  return layers;
}

/// Sizes of the bed's own grains, m.
struct SizesOfBed {
  double d50 = 0, d85 = 0;
};

/// The files, written as the snapshots come.
class Files {
 public:
  explicit Files(const LayerOptions& options) {
    if (!options.measures.empty()) {
      measures_.emplace(options.measures, "fluidisation --measures");
      measures_->write(
          "step,time_s,layer,bed_gradient,layer_gradient,effective_stress_ratio,grains,contacts,coordination_"
          "number,"
          "stable_share,broken_contacts_net,broken_contacts_gross,sliding_share,strong_share,mean_normal_"
          "force_n,"
          "constraint_ratio,verdict,strong_stress_share,coordination_median,coordination_d50,coordination_"
          "d85\n");
    }
    if (!options.distributions.empty()) {
      distributions_.emplace(options.distributions, "fluidisation --distributions");
      distributions_->write("step,time_s,layer,bed_gradient,distribution,low,high,share\n");
    }
  }

  void write(const SnapshotMeasures& snapshot) {
    if (!measures_) return;
    const double bed = snapshot.layers.back().gradient;
    for (std::size_t k = 0; k < snapshot.layers.size(); ++k) {
      const LayerMeasures& layer = snapshot.layers[k];
      const LayerNetwork& network = layer.network;
      measures_->write(
          fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", snapshot.step,
                      snapshot.time, name(k, snapshot.layers.size()), bed, layer.gradient,
                      number_cell(layer.stress_ratio), network.grains, network.contacts, network.coordination,
                      network.stable_share, layer.broken.net, layer.broken.gross, network.sliding_share,
                      network.strong_share, network.mean_normal_force, network.constraint_ratio,
                      to_string(hydromechanical_state(network.constraint_ratio)), network.strong_stress_share,
                      layer.median_coordination, layer.coordination_d50, layer.coordination_d85));
    }
  }

  /// `rest`: the layers' mean normal forces in the first snapshot, N.
  void write_distributions(const SnapshotMeasures& snapshot, const Packing& packing,
                           const HeightLayers& layers, const SlidingRule& rule, const SizesOfBed& sizes,
                           const std::vector<double>& rest) {
    if (!distributions_) return;
    for (std::size_t k = 0; k < snapshot.layers.size(); ++k) {
      const auto layer =
          k + 1 < snapshot.layers.size() ? std::optional<int>(static_cast<int>(k)) : std::nullopt;
      const std::string head = fmt::format("{},{},{},{}", snapshot.step, snapshot.time,
                                           name(k, snapshot.layers.size()), snapshot.layers.back().gradient);
      const std::array<std::pair<const char*, double>, 3> titles{{{"contacts_of_all_grains", 0},
                                                                  {"contacts_of_d50_and_larger", sizes.d50},
                                                                  {"contacts_of_d85_and_larger", sizes.d85}}};
      for (const auto& [title, least] : titles) {
        const ContactCounts counts = coordination_distribution(packing, layers, layer, least);
        for (std::size_t c = 0; c < counts.size(); ++c)
          distributions_->write(fmt::format("{},{},{},{},{}\n", head, title, c,
                                            c + 1 < counts.size() ? std::to_string(c) : "", counts[c]));
      }
      const SlippingShares slipping = slipping_distribution(packing, layers, layer, rule);
      for (std::size_t b = 0; b < slipping.size(); ++b)
        distributions_->write(fmt::format("{},slipping_index,{:g},{:g},{}\n", head,
                                          0.1 * static_cast<double>(b),
                                          std::min(1.0, 0.1 * static_cast<double>(b + 1)), slipping[b]));
      const ForceShares forces = normal_force_distribution(packing, layers, layer, rest[k]);
      for (std::size_t b = 0; b < forces.size(); ++b)
        distributions_->write(fmt::format(
            "{},normal_force_over_mean_at_rest,{:g},{},{}\n", head, kForceBin * static_cast<double>(b),
            b + 1 < forces.size() ? fmt::format("{:g}", kForceBin * static_cast<double>(b + 1)) : "",
            forces[b]));
    }
  }

  void commit() {
    if (measures_) measures_->commit();
    if (distributions_) distributions_->commit();
  }

 private:
  static std::string name(std::size_t layer, std::size_t entries) {
    return layer + 1 < entries ? std::to_string(layer + 1) : "all";
  }

  std::optional<SafeFile> measures_, distributions_;
};

std::string table_of(const SnapshotMeasures& snapshot, const char* when) {
  std::string text = fmt::format("\n{}: step {:.0f}, {:.4g} s, i = {:.4f}\n", when, snapshot.step,
                                 snapshot.time, snapshot.layers.back().gradient);
  text += "layer  sigma'/0        Z      M_s  B_R net    gross      S_c   strong   stress        R\n";
  for (std::size_t k = 0; k < snapshot.layers.size(); ++k) {
    const LayerMeasures& layer = snapshot.layers[k];
    const LayerNetwork& network = layer.network;
    text += fmt::format(
        "{:>5} {:>9} {:>8.3f} {:>8.3f} {:>7.1f}% {:>7.1f}% {:>7.1f}% {:>7.1f}% {:>7.1f}% {:>8.3f}  {}\n",
        k + 1 < snapshot.layers.size() ? std::to_string(k + 1) : "all",
        layer.stress_ratio ? fmt::format("{:.3f}", *layer.stress_ratio) : "", network.coordination,
        network.stable_share, 100 * layer.broken.net, 100 * layer.broken.gross, 100 * network.sliding_share,
        100 * network.strong_share, 100 * network.strong_stress_share, network.constraint_ratio,
        to_string(hydromechanical_state(network.constraint_ratio)));
  }
  return text;
}

}  // namespace

LayerResults layer_measures(const LayerOptions& options, const NumberTable& table, const FlowRecord& record,
                            std::optional<double> onset_step) {
  const StepRecord steps(table, record);
  const HeightLayers layers = layers_of(options, table, record);
  ReadSettings settings;
  settings.who = kFluidisationLayers;
  settings.friction = options.friction;
  const std::unique_ptr<SnapshotSeries> series = open_series(options.files, settings);
  Files files(options);
  std::optional<LayerReference> reference;
  std::vector<double> strong;
  SizesOfBed sizes;
  std::optional<SnapshotMeasures> at_rest, latest, at_onset;
  Snapshot snapshot;
  while (series->next(snapshot)) {
    if (!steps.covers(snapshot)) continue;
    const double step = steps.step_of(snapshot);
    const SlidingRule rule{sliding_tolerance({}, snapshot), true};
    const std::vector<LayerNetwork> networks = layer_networks(snapshot.packing, layers, rule, strong);
    if (!reference) {
      reference.emplace(snapshot.packing, layers);
      for (const LayerNetwork& network : networks) strong.push_back(network.mean_normal_force);
      sizes = {own_size_at(snapshot.packing, 0.5), own_size_at(snapshot.packing, 0.85)};
    }
    const std::vector<BrokenContacts> broken = reference->broken(snapshot.packing);
    SnapshotMeasures measured{step, steps.time(step), {}};
    for (std::size_t k = 0; k < networks.size(); ++k) {
      const auto layer = k + 1 < networks.size() ? std::optional<int>(static_cast<int>(k)) : std::nullopt;
      measured.layers.push_back({networks[k], broken[k], steps.gradient(k, step), steps.stress_ratio(k, step),
                                 median_of(coordination_distribution(snapshot.packing, layers, layer, 0)),
                                 mean_coordination(snapshot.packing, layers, layer, sizes.d50),
                                 mean_coordination(snapshot.packing, layers, layer, sizes.d85)});
    }
    files.write(measured);
    files.write_distributions(measured, snapshot.packing, layers, rule, sizes, strong);
    if (!at_rest) at_rest = measured;
    if (onset_step && step <= *onset_step) at_onset = measured;
    latest = std::move(measured);
  }
  if (!at_rest)
    throw_user_error({kFluidisationLayers, "--dumps", "no snapshot",
                      fmt::format("be from the steps of {}", table.path()),
                      "give grains and contacts of the same run"});
  files.commit();
  if (at_onset && at_onset->step <= at_rest->step) at_onset.reset();
  std::string text = table_of(*at_rest, "first snapshot");
  if (at_onset) text += table_of(*at_onset, "last snapshot before the bed moves");
  if (latest->step > (at_onset ? at_onset->step : at_rest->step)) text += table_of(*latest, "last snapshot");
  text +=
      "strong: f_N of at least the layer's mean in the first snapshot; stress: their part of the vertical "
      "one; R = Z(3 - 2 S_c)/12\n";
  return {std::move(text), *std::move(at_rest), std::move(at_onset)};
}

}  // namespace suffuse::analysis
