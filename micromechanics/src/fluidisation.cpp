#include "suffuse/micromechanics/fluidisation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "suffuse/common/error.h"

namespace suffuse::micromechanics {
namespace {

/// Samples in a row beyond the window's end that end it, so that one bad sample does not.
constexpr std::size_t kSamplesBeyond = 3;

/// Indices of the states to fit.
std::vector<std::size_t> window_of(std::span<const double> gradient, double low, double high) {
  std::vector<std::size_t> inside;
  std::size_t beyond = 0;
  for (std::size_t k = 0; k < gradient.size() && beyond < kSamplesBeyond; ++k) {
    beyond = gradient[k] > high ? beyond + 1 : 0;
    if (gradient[k] >= low && gradient[k] <= high) inside.push_back(k);
  }
  return inside;
}

std::vector<double> picked(std::span<const double> values, std::span<const std::size_t> at) {
  std::vector<double> some;
  some.reserve(at.size());
  for (const std::size_t k : at) some.push_back(values[k]);
  return some;
}

template <class Value>
std::vector<double> series_of(std::span<const FlowState> states, Value value) {
  std::vector<double> values;
  values.reserve(states.size());
  for (const FlowState& state : states) values.push_back(value(state));
  return values;
}

double crossing(double x0, double y0, double x1, double y1, double level) {
  return y1 == y0 ? x1 : x0 + (x1 - x0) * std::clamp((level - y0) / (y1 - y0), 0.0, 1.0);
}

std::optional<OnsetOfMotion> onset_of(std::span<const double> gradient, std::span<const double> rise,
                                      double scatter, const FluidisationSettings& settings) {
  // From the end back: the states that are all above the larger mark, then above the smaller one.
  std::size_t sure = rise.size();
  while (sure > 0 && rise[sure - 1] >= settings.rise_share) --sure;
  if (sure == rise.size() || sure == 0) return std::nullopt;
  const double band = std::min(std::max(settings.band_share, 4 * scatter), settings.rise_share);
  std::size_t first = sure;
  while (first > 1 && rise[first - 1] > band) --first;
  OnsetOfMotion onset;
  onset.state = first;
  onset.last_at_rest = gradient[first - 1];
  onset.first_in_motion = gradient[first];
  onset.gradient = crossing(gradient[first - 1], rise[first - 1], gradient[first], rise[first], band);
  onset.risen = crossing(gradient[sure - 1], rise[sure - 1], gradient[sure], rise[sure], settings.rise_share);
  return onset;
}

/// Where the stress vanishes by its line; none where it does not fall.
std::optional<double> vanishing(const std::optional<LineFit>& line) {
  if (!line || !(line->slope < 0)) return std::nullopt;
  return line->root();
}

LayerFluidisation measure_layer(std::span<const FlowState> states, std::size_t layer,
                                std::span<const std::size_t> window, std::span<const double> velocity) {
  LayerFluidisation result;
  const auto own = picked(series_of(states, [&](const FlowState& s) { return s.gradient[layer]; }), window);
  result.flow = fit_line(own, velocity);
  const bool stressed = !states.front().stress.empty() && states.front().stress[layer] > 0;
  if (!stressed) return result;
  const double reference = states.front().stress[layer];
  const auto ratio =
      picked(series_of(states, [&](const FlowState& s) { return s.stress[layer] / reference; }), window);
  const auto lifting = picked(
      series_of(states, [&](const FlowState& s) { return lifting_gradient(s.gradient, layer); }), window);
  result.stress = fit_line(own, ratio);
  result.local = vanishing(result.stress);
  result.by_lifting = vanishing(fit_line(lifting, ratio));
  return result;
}

double total_stress(const FlowState& state) {
  double sum = 0;
  for (const double stress : state.stress) sum += stress;
  return sum;
}

}  // namespace

std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y) {
  const std::size_t points = std::min(x.size(), y.size());
  if (points < 2) return std::nullopt;
  const auto n = static_cast<double>(points);
  double mean_x = 0, mean_y = 0;
  for (std::size_t k = 0; k < points; ++k) {
    mean_x += x[k] / n;
    mean_y += y[k] / n;
  }
  double xx = 0, xy = 0;
  for (std::size_t k = 0; k < points; ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  if (!(xx > 0)) return std::nullopt;
  LineFit line;
  line.points = points;
  line.slope = xy / xx;
  line.intercept = mean_y - line.slope * mean_x;
  double squares = 0;
  for (std::size_t k = 0; k < points; ++k) squares += std::pow(y[k] - line.at(x[k]), 2);
  line.scatter = std::sqrt(squares / n);
  if (points > 2) line.slope_error = std::sqrt(squares / (n - 2) / xx);
  return line;
}

double bed_gradient(std::span<const double> layers) {
  double sum = 0;
  for (const double gradient : layers) sum += gradient;
  return sum / static_cast<double>(layers.size());
}

double lifting_gradient(std::span<const double> layers, std::size_t layer) {
  double sum = layers[layer] / 2;
  for (std::size_t above = 0; above < layer; ++above) sum += layers[above];
  return sum / (static_cast<double>(layer) + 0.5);
}

double mean_lifting_gradient(std::span<const double> layers) {
  double sum = 0, weights = 0;
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    const double weight = static_cast<double>(layers.size() - layer) - 0.5;
    sum += weight * layers[layer];
    weights += weight;
  }
  return sum / weights;
}

std::vector<Hold> holds_of(std::span<const double> driving, std::size_t least) {
  double largest = 0;
  for (const double value : driving) largest = std::max(largest, std::abs(value));
  std::vector<Hold> holds;
  for (std::size_t first = 0; first < driving.size();) {
    std::size_t end = first + 1;
    while (end < driving.size() && std::abs(driving[end] - driving[first]) <= 1e-6 * largest) ++end;
    if (end - first >= least) holds.emplace_back(first, end - 1);
    first = end;
  }
  return holds;
}

std::vector<FlowState> held_states(std::span<const FlowState> samples, std::span<const Hold> holds) {
  std::vector<FlowState> states;
  for (const auto& [first, last] : holds) {
    const std::size_t from = first + (last - first + 1) / 2;
    FlowState mean = samples[last];  // time and centre of the end
    mean.velocity = 0;
    std::fill(mean.gradient.begin(), mean.gradient.end(), 0.0);
    std::fill(mean.stress.begin(), mean.stress.end(), 0.0);
    const double weight = 1 / static_cast<double>(last - from + 1);
    for (std::size_t k = from; k <= last; ++k) {
      mean.velocity += weight * samples[k].velocity;
      for (std::size_t l = 0; l < mean.gradient.size(); ++l)
        mean.gradient[l] += weight * samples[k].gradient[l];
      for (std::size_t l = 0; l < mean.stress.size(); ++l) mean.stress[l] += weight * samples[k].stress[l];
    }
    states.push_back(std::move(mean));
  }
  return states;
}

Fluidisation measure_fluidisation(std::span<const FlowState> states, double critical, double height,
                                  const FluidisationSettings& settings) {
  const auto gradient = series_of(states, [](const FlowState& s) { return bed_gradient(s.gradient); });
  const double low = (settings.window_low - settings.window_slack) * critical;
  const double high = (settings.window_high + settings.window_slack) * critical;
  const std::vector<std::size_t> window = window_of(gradient, low, high);
  const auto x = picked(gradient, window);
  const double spread =
      x.empty() ? 0 : *std::max_element(x.begin(), x.end()) - *std::min_element(x.begin(), x.end());
  const double largest = states.empty() ? 0 : *std::max_element(gradient.begin(), gradient.end());
  if (x.size() < 3 || spread < 0.2 * critical)
    throw_user_error(
        {"fluidisation", "gradients of the bed",
         fmt::format("{} between {:.3g} and {:.3g} (largest {:.3g})", x.size(), low, high, largest),
         fmt::format("be at least three, spread over {:.3g}", 0.2 * critical),
         "let the run go on, or sample more often"});

  Fluidisation result;
  result.largest_gradient = largest;
  const auto velocity = picked(series_of(states, [](const FlowState& s) { return s.velocity; }), window);
  result.flow = *fit_line(x, velocity);
  for (std::size_t layer = 0; layer < states.front().gradient.size(); ++layer)
    result.layers.push_back(measure_layer(states, layer, window, velocity));
  const double at_rest = total_stress(states.front());
  if (at_rest > 0) {
    const auto ratio =
        picked(series_of(states, [&](const FlowState& s) { return total_stress(s) / at_rest; }), window);
    const auto lifting = picked(
        series_of(states, [](const FlowState& s) { return mean_lifting_gradient(s.gradient); }), window);
    result.stress = fit_line(lifting, ratio);
  }
  auto rise = series_of(states, [&](const FlowState& s) { return s.centre / height; });
  const LineFit elastic = *fit_line(x, picked(rise, window));
  for (std::size_t k = 0; k < rise.size(); ++k) rise[k] -= elastic.at(gradient[k]);
  result.onset = onset_of(gradient, rise, elastic.scatter, settings);
  return result;
}

std::optional<double> gradient_at_fall(std::span<const double> gradient, std::span<const double> values,
                                       double level) {
  std::size_t first = values.size();
  while (first > 0 && values[first - 1] < level) --first;
  if (first == values.size() || first == 0) return std::nullopt;
  return crossing(gradient[first - 1], values[first - 1], gradient[first], values[first], level);
}

}  // namespace suffuse::micromechanics
