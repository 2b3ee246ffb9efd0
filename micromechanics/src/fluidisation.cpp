#include "suffuse/micromechanics/fluidisation.h"

#include <fmt/format.h>

#include <Eigen/Dense>

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

/// A run's states: those that lines are fitted to, and how many of the first are at rest.
struct Course {
  std::span<const FlowState> states;
  std::vector<std::size_t> window;
  std::size_t at_rest = 0;
};

/// σ'/σ'_0 of a layer; empty where it is not known.
std::vector<double> stress_ratio(std::span<const FlowState> states, std::size_t layer) {
  if (states.front().stress.empty() || !(states.front().stress[layer] > 0)) return {};
  const double reference = states.front().stress[layer];
  return series_of(states, [&](const FlowState& s) { return s.stress[layer] / reference; });
}

std::vector<double> lifting_gradients(std::span<const FlowState> states, std::size_t layer) {
  return series_of(states, [&](const FlowState& s) { return lifting_gradient(s.gradient, layer); });
}

std::optional<LineFit> fit_in_window(const Course& course, const std::vector<double>& x,
                                     const std::vector<double>& y) {
  return fit_line(picked(x, course.window), picked(y, course.window));
}

/// Where the stress vanishes by its line; none where it does not fall, or not along that line.
std::optional<double> vanishing(const Course& course, const std::optional<LineFit>& line,
                                const std::vector<double>& gradient, const std::vector<double>& ratio) {
  if (!line || !(line->slope < 0)) return std::nullopt;
  const double root = line->root();
  double largest = 0;
  for (std::size_t k = course.window.front(); k < course.at_rest; ++k) {
    largest = std::max(largest, gradient[k]);
    if (std::abs(ratio[k] - std::max(0., line->at(gradient[k]))) > kBentStress) return std::nullopt;
  }
  if (root > kFarGradient * largest) return std::nullopt;
  return root;
}

LayerFluidisation measure_layer(const Course& course, std::size_t layer, std::span<const double> velocity) {
  LayerFluidisation result;
  const auto own = series_of(course.states, [&](const FlowState& s) { return s.gradient[layer]; });
  result.flow = fit_line(picked(own, course.window), velocity);
  const std::vector<double> ratio = stress_ratio(course.states, layer);
  if (ratio.empty()) return result;
  result.stress = fit_in_window(course, own, ratio);
  result.local = vanishing(course, result.stress, own, ratio);
  const std::vector<double> lifting = lifting_gradients(course.states, layer);
  result.by_lifting = vanishing(course, fit_in_window(course, lifting, ratio), lifting, ratio);
  return result;
}

}  // namespace

double LineFit::root_error() const {
  // y(x) at the mean and the slope are uncorrelated: var(root) = [var(y at mean) + (root − mean)²
  // var(slope)]/slope².
  if (points < 3) return 0;
  const auto n = static_cast<double>(points);
  const double at_mean =
      scatter * scatter / (n - 2);  // scatter² n/(n − 2) is the variance of a point, over n
  return std::sqrt(at_mean + std::pow((root() - mean_x) * slope_error, 2)) / std::abs(slope);
}

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
  line.mean_x = mean_x;
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

std::optional<ParabolaFit> fit_parabola(std::span<const double> x, std::span<const double> y) {
  const auto points = static_cast<Eigen::Index>(std::min(x.size(), y.size()));
  if (points < 3) return std::nullopt;
  // About the middle of x and over its width, so that the columns are far from parallel.
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  const double middle = (*low + *high) / 2, width = *high - *low;
  if (!(width > 0)) return std::nullopt;
  Eigen::MatrixX3d columns(points, 3);
  Eigen::VectorXd values(points);
  for (Eigen::Index k = 0; k < points; ++k) {
    const double u = (x[static_cast<std::size_t>(k)] - middle) / width;
    columns.row(k) << 1, u, u * u;
    values[k] = y[static_cast<std::size_t>(k)];
  }
  const auto solver = columns.colPivHouseholderQr();
  if (solver.rank() < 3) return std::nullopt;
  const Eigen::Vector3d c = solver.solve(values);
  ParabolaFit fit;
  fit.square = c[2] / (width * width);
  fit.linear = c[1] / width - 2 * fit.square * middle;
  fit.constant = c[0] - c[1] * middle / width + fit.square * middle * middle;
  fit.scatter = (columns * c - values).norm() / std::sqrt(static_cast<double>(points));
  return fit;
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
  Course course{states, window_of(gradient, low, high), states.size()};
  const std::vector<std::size_t>& window = course.window;
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
  auto rise = series_of(states, [&](const FlowState& s) { return s.centre / height; });
  if (const auto elastic = fit_parabola(x, picked(rise, window))) {
    for (std::size_t k = 0; k < rise.size(); ++k) rise[k] -= elastic->at(gradient[k]);
    result.onset = onset_of(gradient, rise, elastic->scatter, settings);
  }
  if (result.onset) course.at_rest = result.onset->state;
  for (std::size_t layer = 0; layer < states.front().gradient.size(); ++layer)
    result.layers.push_back(measure_layer(course, layer, velocity));
  const std::size_t lowest = states.front().gradient.size() - 1;
  if (const auto ratio = stress_ratio(states, lowest); !ratio.empty())
    result.stress = fit_in_window(course, lifting_gradients(states, lowest), ratio);
  return result;
}

std::optional<double> gradient_at_fall(std::span<const double> gradient, std::span<const double> values,
                                       double level, std::size_t in_a_row) {
  std::size_t below = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    below = values[k] < level ? below + 1 : 0;
    if (below < in_a_row) continue;
    const std::size_t first = k + 1 - below;
    if (first == 0) return std::nullopt;
    return crossing(gradient[first - 1], values[first - 1], gradient[first], values[first], level);
  }
  return std::nullopt;
}

Lifting measure_lifting(std::span<const double> velocity, std::span<const double> drop, double low,
                        double high) {
  const std::vector<std::size_t> window = window_of(drop, low, high);
  if (window.size() < 3)
    throw_user_error({"lifting", "samples with a drop in the window", fmt::format("{}", window.size()),
                      fmt::format("be at least three between {:g} and {:g} of the weight", low, high),
                      "a faster flow, or samples more often"});
  const auto line = fit_line(picked(velocity, window), picked(drop, window));
  if (!line || !(line->slope > 0))
    throw_user_error({"lifting", "pressure drop in the window", "does not rise with the velocity",
                      "be that of a packed bed", ""});
  Lifting lifting;
  lifting.packed = *line;
  lifting.velocity = (1 - line->intercept) / line->slope;
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < drop.size(); ++k) {
    lifting.largest = std::max(lifting.largest, drop[k]);
    if (velocity[k] < 1.3 * lifting.velocity) continue;
    sum += drop[k];
    ++count;
  }
  if (count > 0) lifting.floating = sum / count;
  return lifting;
}

}  // namespace suffuse::micromechanics
