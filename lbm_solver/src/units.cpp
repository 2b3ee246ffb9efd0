#include "suffuse/lbm/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "suffuse/common/error.h"

namespace suffuse::lbm {

namespace {

constexpr const char* kWho = "fluid units";
constexpr double kLargestMach = 0.5, kLargestDensityDifference = 0.3;

void require_positive(const char* what, const std::optional<double>& value, const char* unit) {
  if (value && !(*value > 0 && std::isfinite(*value)))
    throw_user_error({kWho, what, fmt::format("{}{}", *value, unit), "be > 0 and finite", ""});
}

void check_request(const UnitsRequest& r) {
  require_positive("density", r.density, " kg/m3");
  require_positive("viscosity", r.viscosity, " m2/s");
  require_positive("spacing", r.spacing, " m");
  require_positive("timestep", r.time_step, " s");
  require_positive("mach", r.mach, "");
  require_positive("max_velocity", r.largest_velocity, " m/s");
  if (r.pressure_difference && !std::isfinite(*r.pressure_difference))
    throw_user_error(
        {kWho, "pressure_difference", fmt::format("{} Pa", *r.pressure_difference), "be finite", ""});
  if (r.relaxation_time && !(*r.relaxation_time > 0.5 && std::isfinite(*r.relaxation_time)))
    throw_user_error({kWho, "relaxation_time", fmt::format("{}", *r.relaxation_time), "be > 0.5",
                      "raise viscosity or timestep"});
  const int given = int(r.spacing.has_value()) + int(r.relaxation_time.has_value()) +
                    int(r.time_step.has_value()) + int(r.mach.has_value());
  if (given != 2)
    throw_user_error({kWho, "number of given values among spacing, relaxation_time, timestep and mach",
                      fmt::format("{}", given), "be two", "the other two follow"});
  if (r.mach && !r.largest_velocity)
    throw_user_error({kWho, "mach", fmt::format("{}", *r.mach), "come with the velocity it is meant for",
                      "add max_velocity"});
}

}  // namespace

Units::Units(const UnitsRequest& r)
    : density_(r.density), viscosity_(r.viscosity), only_cells_and_steps_(r.only_cells_and_steps) {
  check_request(r);
  largest_velocity_ = r.largest_velocity.value_or(0);
  pressure_difference_ = r.pressure_difference.value_or(0);
  // dt/dx, where a Mach number gives it.
  const double slowness = r.mach ? *r.mach / (std::sqrt(3.) * *r.largest_velocity) : 0;
  const double excess = r.relaxation_time ? *r.relaxation_time - 0.5 : 0;
  if (r.spacing)
    spacing_ = *r.spacing;
  else if (r.relaxation_time && r.time_step)
    spacing_ = std::sqrt(3 * viscosity_ * *r.time_step / excess);
  else if (r.relaxation_time)
    spacing_ = 3 * viscosity_ * slowness / excess;
  else
    spacing_ = *r.time_step / slowness;
  if (r.time_step)
    time_step_ = *r.time_step;
  else if (r.mach)
    time_step_ = slowness * spacing_;
  else
    time_step_ = excess * spacing_ * spacing_ / (3 * viscosity_);
  relaxation_time_ = r.relaxation_time.value_or(0.5 + 3 * viscosity_ * time_step_ / (spacing_ * spacing_));
  check();
}

void Units::check() const {
  for (const auto& [what, value, unit] : {std::tuple{"spacing", spacing_, " m"},
                                          {"timestep", time_step_, " s"},
                                          {"relaxation_time", relaxation_time_, ""}})
    require_positive(what, value, unit);
  if (only_cells_and_steps_) return;
  if (!(relaxation_time_ - 0.5 > 1e-5))
    throw_user_error(
        {kWho, "relaxation_time", fmt::format("{:.6f}", relaxation_time_), "be above 0.50001",
         "raise viscosity, or lower spacing (timestep and spacing together at the same velocity)"});
  if (mach() > kLargestMach)
    throw_user_error({kWho, "mach", fmt::format("{:.3g} at {:g} m/s", mach(), largest_velocity_),
                      fmt::format("be below {}", kLargestMach),
                      fmt::format("lower timestep to {:.2g} s or less", time_step_ * 0.1 / mach())});
  if (density_difference() > kLargestDensityDifference)
    throw_user_error({kWho, "density difference",
                      fmt::format("{:.3g} for {:g} Pa", density_difference(), pressure_difference_),
                      fmt::format("be below {}", kLargestDensityDifference),
                      fmt::format("lower timestep to {:.2g} s or less",
                                  time_step_ * std::sqrt(0.03 / density_difference()))});
}

long Units::steps_in(double seconds) const {
  return std::max(1L, std::lround(std::min(kMostSteps, time_to_lattice(seconds))));
}

double Units::mach() const {
  return velocity_to_lattice(largest_velocity_) * std::sqrt(3.);
}
double Units::grid_reynolds() const {
  return largest_velocity_ * spacing_ / viscosity_;
}
double Units::density_difference() const {
  return 3 * std::abs(pressure_difference_) / pressure_unit();
}

std::string Units::summary() const {
  if (only_cells_and_steps_) return fmt::format("spacing {:.4g} m, timestep {:.4g} s", spacing_, time_step_);
  std::string line = fmt::format("spacing {:.4g} m, timestep {:.4g} s, relaxation time {:.4g}", spacing_,
                                 time_step_, relaxation_time_);
  if (largest_velocity_ > 0)
    line += fmt::format(", Mach {:.3g} and grid Reynolds number {:.3g} at {:g} m/s", mach(), grid_reynolds(),
                        largest_velocity_);
  if (pressure_difference_ != 0)
    line += fmt::format(", density difference {:.3g} % at {:g} Pa", 100 * density_difference(),
                        pressure_difference_);
  return line;
}

std::vector<std::string> Units::warnings() const {
  std::vector<std::string> lines;
  if (only_cells_and_steps_) return lines;
  if (mach() > 0.17)
    lines.push_back(
        fmt::format("Mach {:.2f}: compressibility costs about {:.0f} % of accuracy; a timestep of {:.2g} s "
                    "brings it below one per cent",
                    mach(), 100 * mach() * mach(), time_step_ * 0.1 / mach()));
  if (grid_reynolds() > 10)
    lines.push_back(fmt::format(
        "grid Reynolds number {:.0f}: the flow changes too fast from cell to cell; lower "
        "spacing, or take an eddy viscosity (`lbm effect turbulence on`; `smagorinsky` of suffuse-flow)",
        grid_reynolds()));
  if (density_difference() > 0.03)
    lines.push_back(
        fmt::format("density difference {:.1f} %: take `incompressible`, or a timestep of {:.2g} s",
                    100 * density_difference(), time_step_ * std::sqrt(0.03 / density_difference())));
  if (relaxation_time_ > 2)
    lines.push_back(
        fmt::format("relaxation time {:.2f}: velocities lag behind the forces near walls; a timestep of "
                    "{:.2g} s gives 1",
                    relaxation_time_, time_step_ * 0.5 / (relaxation_time_ - 0.5)));
  return lines;
}

}  // namespace suffuse::lbm
