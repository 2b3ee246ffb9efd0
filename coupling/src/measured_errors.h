#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace suffuse::coupling {

/// Errors that packings showed at so many cells a Sauter diameter, shares.
struct MeasuredError {
  double cells, rms, largest;
};

/// Powers of the resolution between the measured ones (rising cells); as the last beyond it, and on as
/// between the first two below, down to 1.5 cells.
inline double error_at(std::span<const MeasuredError> measured, double cells, double MeasuredError::*error) {
  const double at = std::clamp(cells, 1.5, measured.back().cells);
  std::size_t n = 1;
  while (measured[n].cells < at) ++n;
  const MeasuredError &coarse = measured[n - 1], &fine = measured[n];
  const double order = std::log(coarse.*error / fine.*error) / std::log(fine.cells / coarse.cells);
  return fine.*error * std::pow(fine.cells / at, order);
}

}  // namespace suffuse::coupling
