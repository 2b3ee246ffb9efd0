#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "suffuse/micromechanics/fluidisation.h"

namespace suffuse::analysis {

/// A table of numbers from a CSV file: one row of names, then rows of as many finite numbers; lines that
/// begin with # are left out.
class NumberTable {
 public:
  /// Throws UserError (`who` first, then file and line) where the file cannot be read, a row is short or has
  /// something else than finite numbers, a name is there twice, there are no rows, or time_s goes back (two
  /// runs one behind the other).
  NumberTable(const std::string& path, const std::string& who);

  const std::string& path() const { return path_; }
  std::size_t rows() const { return columns_.front().size(); }
  /// nullptr where there is no such column.
  const std::vector<double>* find(std::string_view name) const;
  /// Throws UserError where there is none.
  const std::vector<double>& column(std::string_view name) const;
  /// The same, of numbers that do not fall. Throws UserError where they do.
  const std::vector<double>& rising_column(std::string_view name) const;
  /// Columns PREFIX1, PREFIX2, … as far as they go.
  std::vector<const std::vector<double>*> numbered(std::string_view prefix) const;

 private:
  std::string path_, who_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
};

/// What the monitor of an upward-flow run says about its bed (docs/reference/lbm.md, monitor). Needs
/// superficial_velocity and layer_gradient; bed, layer_porosity and vertical_stress_pa_N (or
/// effective_stress_ratio_N) where they are there.
struct FlowRecord {
  char axis = 'z';
  std::vector<micromechanics::FlowState> states;  ///< all samples
  std::vector<double> driving;                    ///< applied_gradient, else the bed's own
  bool has_driving = false;
  double porosity = 0, height = 0;  ///< of the bed at rest: those of the first sample
  /// V_s/(A H) of all grains over the height H of the layers (column layers_height_m): 1 − n, and with it
  /// what sticks out above.
  std::optional<double> solids_over_layers;
  std::vector<double> layer_porosity;  ///< at rest; empty where it is not watched
  bool stress_in_pa = false;           ///< else ratios to the first sample
  bool layers_on_floor = true;         ///< does the lowest layer touch it (column layers_floor_m is 0)?
};

/// S² of the layers' void ratios at rest (thesis eq 6.1).
struct LayerVariance {
  double all = 0;
  double upper = 0;  ///< without the lowest layer
};
/// None for fewer than three layers.
std::optional<LayerVariance> layer_variance(const FlowRecord& record);

/// `height`: of the bed, m, where the file does not tell it. Throws UserError where a column is missing or
/// the bed has no porosity.
FlowRecord flow_record(const NumberTable& table, const std::string& who, std::optional<double> height);

}  // namespace suffuse::analysis
