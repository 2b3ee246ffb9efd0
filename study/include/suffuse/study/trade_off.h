#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace suffuse::study {

/// What a run cost and how wrong it was. Without an error (a run that failed, or the reference itself) it
/// takes no part.
struct TradeOff {
  double seconds = 0;
  std::optional<double> error;  ///< >= 0
};

/// Which runs no other run beats: no other is at least as fast and at least as accurate, and better in one of
/// both (Pareto's front). Equal runs are on it together.
std::vector<bool> pareto_front(const std::vector<TradeOff>& runs);

/// The fastest run with an error of at most `limit`; nothing where there is none.
std::optional<std::size_t> fastest_within(const std::vector<TradeOff>& runs, double limit);

/// The most accurate run, the faster one of two equal ones; nothing where none has an error.
std::optional<std::size_t> most_accurate(const std::vector<TradeOff>& runs);

/// value/reference − 1, positive where the value is too large. The reference is not 0.
double relative_error(double value, double reference);

}  // namespace suffuse::study
