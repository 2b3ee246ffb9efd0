#include "suffuse/study/trade_off.h"

namespace suffuse::study {

std::vector<bool> pareto_front(const std::vector<TradeOff>& runs) {
  std::vector<bool> on_front(runs.size(), false);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].error) continue;
    on_front[i] = true;
    for (const TradeOff& other : runs) {
      if (!other.error) continue;
      const bool as_good = other.seconds <= runs[i].seconds && *other.error <= *runs[i].error;
      const bool better = other.seconds < runs[i].seconds || *other.error < *runs[i].error;
      if (as_good && better) on_front[i] = false;
    }
  }
  return on_front;
}

std::optional<std::size_t> fastest_within(const std::vector<TradeOff>& runs, double limit) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].error && *runs[i].error <= limit && (!best || runs[i].seconds < runs[*best].seconds))
      best = i;
  return best;
}

std::optional<std::size_t> most_accurate(const std::vector<TradeOff>& runs) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].error) continue;
    const bool better = !best || *runs[i].error < *runs[*best].error ||
                        (*runs[i].error == *runs[*best].error && runs[i].seconds < runs[*best].seconds);
    if (better) best = i;
  }
  return best;
}

double relative_error(double value, double reference) {
  return value / reference - 1;
}

}  // namespace suffuse::study
