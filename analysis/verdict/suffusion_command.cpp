#include "verdict/suffusion_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "suffuse/common/error.h"
#include "suffuse/micromechanics/suffusion.h"
#include "verdict/flow_record.h"
#include "verdict/result_outputs.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

constexpr const char* kSuffusion = "suffusion";
constexpr std::array<double, 3> kErodedShares{0.002, 0.01, 0.05};
constexpr std::array<const char*, 3> kErodedNames{"onset_2_permille", "onset_1_percent", "onset_5_percent"};

struct SuffusionOptions {
  ResultOutputs outputs;
  std::string file;
};

std::vector<SuffusionState> states_of(const NumberTable& table) {
  const auto &gradient = table.column("applied_gradient"), &eroded = table.column("eroded_fines_share");
  const auto fines = table.numbered("fines_share_layer_"),
             local = table.numbered("hydraulic_gradient_layer_");
  if (fines.empty() || fines.size() != local.size())
    throw_user_error({kSuffusion, table.path(),
                      fmt::format("{} columns fines_share_layer_N, {} hydraulic_gradient_layer_N",
                                  fines.size(), local.size()),
                      "have one of each for every layer", "see scene 09's `lbm monitor`"});
  std::vector<SuffusionState> states(table.rows());
  for (std::size_t n = 0; n < states.size(); ++n) {
    states[n].gradient = gradient[n];
    states[n].eroded_share = eroded[n];
    for (std::size_t layer = 0; layer < fines.size(); ++layer) {
      states[n].fines_share.push_back((*fines[layer])[n]);
      states[n].layer_gradient.push_back((*local[layer])[n]);
    }
  }
  return states;
}

/// The largest magnitude, and whether the water was driven down, or both ways.
struct Driving {
  double largest = 0;
  std::string way;
};

Driving driving_of(const std::vector<SuffusionState>& states) {
  double low = 0, high = 0;
  for (const SuffusionState& state : states) {
    low = std::min(low, state.gradient);
    high = std::max(high, state.gradient);
  }
  return {std::max(high, -low), low == 0 ? "" : high == 0 ? "downwards" : "up and down, by magnitudes"};
}

ResultRows rows_of(const SuffusionOnset& onset, const Driving& driving) {
  ResultRows rows;
  const std::string never = fmt::format("not reached; largest gradient {:.3f}", driving.largest);
  const auto add = [&](const std::string& name, std::optional<double> gradient, const char* source) {
    rows.add(name, "i", gradient, "-", source, gradient ? driving.way : never);
  };
  add("gradient, fines begin to move inside", onset.inside,
      "a layer's fines content off by a twentieth of itself");
  for (std::size_t k = 0; k < kErodedShares.size(); ++k)
    add(fmt::format("gradient, {:g} % of the fines have left", 100 * kErodedShares[k]), onset.eroded[k],
        "eroded_fines_share");
  rows.add("steepest layer over the mean", "", onset.steepest_layer, "-", "after the first tenth",
           "above 1 where a layer clogs");
  return rows;
}

/// As scripts take them; `none` where a gradient was never reached.
Record variables_of(const SuffusionOnset& onset) {
  Record record{{"onset_inside", onset.inside, true}, {"steepest_layer", onset.steepest_layer}};
  for (std::size_t k = 0; k < kErodedNames.size(); ++k)
    record.push_back({kErodedNames[k], onset.eroded[k], true});
  return record;
}

void run(const SuffusionOptions& options) {
  options.outputs.require_new(kSuffusion, {options.file});
  const std::vector<SuffusionState> states = states_of(NumberTable(options.file, kSuffusion));
  const SuffusionOnset onset = suffusion_onset(states, kErodedShares);
  const ResultRows rows = rows_of(onset, driving_of(states));
  options.outputs.write(rows, kSuffusion, [&] { return variables_of(onset); });
  fmt::print("{}", rows.text());
}

}  // namespace

void add_suffusion(CLI::App& app) {
  auto options = std::make_shared<SuffusionOptions>();
  CLI::App* command =
      app.add_subcommand(kSuffusion, "Gradients at which fines leave a sample under seepage (scene 09)");
  command
      ->add_option("FLOW", options->file,
                   "CSV file of `lbm monitor`: applied_gradient, eroded_fines_share, fines_share_layer_N, "
                   "hydraulic_gradient_layer_N")
      ->required();
  options->outputs.add_rows(*command);
  options->outputs.add_variables(
      *command, "file of `variable` lines for a script to include, `none` for gradients never reached");
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
