#include "verdict/onset_table.h"

#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "files/record_table.h"

namespace suffuse::analysis {
namespace {

using Value = std::optional<double>;

/// What the thesis says of a layer: at rest, and at the onset.
using Said = std::pair<Value, Value>;

/// A quantity of the layers with what the thesis says of its Layer 1, its Layer 10 and all of them.
struct Quantity {
  const char *name, *symbol, *section;
  Value (*of)(const LayerMeasures&);
  Said top, bottom, all;
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> rows{
      {"effective stress over that at rest",
       "sigma'/sigma'_0",
       "6.5.1",
       [](const LayerMeasures& m) { return m.stress_ratio; },
       {},
       {{}, 0.0},
       {}},
      {"strong contacts",
       "f_N >= f_0",
       "6.5.2",
       [](const LayerMeasures& m) -> Value { return m.network.strong_share; },
       {0.40, 0.0},
       {0.40, 0.0},
       {0.40, 0.0}},
      {"vertical stress that strong contacts carry",
       "",
       "6.5.2",
       [](const LayerMeasures& m) -> Value { return m.network.strong_stress_share; },
       {0.9, {}},
       {0.9, {}},
       {0.9, {}}},
      {"broken contacts, net",
       "B_R",
       "6.5.3",
       [](const LayerMeasures& m) -> Value { return m.broken.net; },
       {0.0, 0.05},
       {0.0, 0.17},
       {}},
      {"broken contacts, gross",
       "B_R",
       "6.5.3",
       [](const LayerMeasures& m) -> Value { return m.broken.gross; },
       {0.0, 0.05},
       {0.0, 0.17},
       {}},
      {"mechanically stable grains",
       "M_s",
       "6.5.4",
       [](const LayerMeasures& m) -> Value { return m.network.stable_share; },
       {{}, 0.75},
       {{}, 0.75},
       {{}, 0.75}},
      {"coordination number, median",
       "Z_50",
       "6.5.5",
       [](const LayerMeasures& m) -> Value { return m.median_coordination; },
       {{}, 4.0},
       {{}, 4.0},
       {{}, 4.0}},
      {"coordination number, mean",
       "Z",
       "6.5.5",
       [](const LayerMeasures& m) -> Value { return m.network.coordination; },
       {4.811, 4.6},
       {5.405, 4.6},
       {{}, 4.6}},
      {"coordination number, d >= d50",
       "Z",
       "6.5.5",
       [](const LayerMeasures& m) -> Value { return m.coordination_d50; },
       {},
       {},
       {}},
      {"coordination number, d >= d85",
       "Z",
       "6.5.5",
       [](const LayerMeasures& m) -> Value { return m.coordination_d85; },
       {},
       {},
       {}},
      {"sliding contacts",
       "S_c",
       "6.5.6",
       [](const LayerMeasures& m) -> Value { return m.network.sliding_share; },
       {},
       {{}, 0.17},
       {}},
      {"constraint ratio",
       "R",
       "6.5.7",
       [](const LayerMeasures& m) -> Value { return m.network.constraint_ratio; },
       {{}, 1.0},
       {{}, 1.0},
       {{}, 1.0}},
  };
  return rows;
}

}  // namespace

std::string onset_table(const LayerResults& results, const OnsetOfRun& run) {
  std::string text = "quantity,symbol,layer,at_rest,at_onset,thesis_at_rest,thesis_at_onset,section\n";
  const auto add = [&](const char* name, const char* symbol, const std::string& layer, const Value& at_rest,
                       const Value& at_onset, const Said& said, const char* section) {
    text += fmt::format("\"{}\",{},{},{},{},{},{},{}\n", name, symbol, layer, number_cell(at_rest),
                        number_cell(at_onset), run.thesis_soil ? number_cell(said.first) : "",
                        run.thesis_soil ? number_cell(said.second) : "", section);
  };
  const std::size_t layers = results.at_rest.layers.size() - 1;
  const std::string lowest = std::to_string(layers);
  add("variance of the layers' void ratios", "S2", "all", run.variance, {}, {2.72e-5, {}}, "6.3");
  add("hydraulic gradient of the bed", "i", "all", results.at_rest.layers[layers].gradient, run.gradient,
      {0.0, 1.050}, "6.4");
  add("hydraulic gradient of the layer", "i", lowest, results.at_rest.layers[layers - 1].gradient,
      run.lowest_gradient, {0.0, 1.251}, "6.5.6");
  for (const Quantity& quantity : quantities()) {
    const std::array<std::pair<std::size_t, const Said*>, 3> places{
        {{0, &quantity.top}, {layers - 1, &quantity.bottom}, {layers, &quantity.all}}};
    for (const auto& [k, said] : places)
      add(quantity.name, quantity.symbol, k < layers ? std::to_string(k + 1) : "all",
          quantity.of(results.at_rest.layers[k]),
          results.at_onset ? quantity.of(results.at_onset->layers[k]) : std::nullopt, *said,
          quantity.section);
  }
  return text;
}

}  // namespace suffuse::analysis
