#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suffuse/common/linear_algebra.h"

namespace suffuse::lbm {

/// What a person asks for, in SI. Of spacing, relaxation time, time step and Mach number exactly two must be
/// given; the other two follow from nu = (tau - 1/2)/3 dx^2/dt (thesis eq 3.23) and Ma = U sqrt(3) dt/dx.
struct UnitsRequest {
  double density = 1000;                  ///< kg/m^3
  double viscosity = 1e-6;                ///< kinematic, m^2/s
  std::optional<double> spacing;          ///< cell size, m
  std::optional<double> relaxation_time;  ///< tau, steps
  std::optional<double> time_step;        ///< s
  std::optional<double> mach;  ///< largest velocity / speed of sound of the lattice (needs largest_velocity)

  std::optional<double> largest_velocity;     ///< expected, m/s: for the Mach and grid Reynolds numbers
  std::optional<double> pressure_difference;  ///< expected over the box, Pa: for the density difference

  /// Cells and steps of something else than a lattice: any relaxation time and Mach number will do.
  bool only_cells_and_steps = false;
};

/// The one place where SI becomes lattice units (cells, steps, reference density one) and back.
class Units {
 public:
  /// A UserError that names the remedy if the request is incomplete, contradictory or cannot work: relaxation
  /// time not above 0.5, Mach number above 0.5, density difference above 0.3.
  explicit Units(const UnitsRequest& request);

  double spacing() const { return spacing_; }
  double time_step() const { return time_step_; }
  double density() const { return density_; }
  double relaxation_time() const { return relaxation_time_; }
  double viscosity_si() const { return viscosity_; }

  /// Of the largest velocity and the pressure difference of the request; zero where none was given.
  double mach() const;
  double grid_reynolds()
      const;  ///< U dx / nu; below about 10 the flow between neighbouring cells stays smooth
  double density_difference() const;  ///< 3 dp_lattice

  double time_to_lattice(double seconds) const { return seconds / time_step_; }
  double time_to_si(double steps) const { return steps * time_step_; }
  /// An interval of so many seconds > 0, rounded to whole steps: one at least, and kMostSteps at most.
  long steps_in(double seconds) const;
  static constexpr double kMostSteps = 1e15;  ///< no run gets there
  double velocity_to_lattice(double si) const { return si * time_step_ / spacing_; }
  double velocity_to_si(double lattice) const { return lattice * spacing_ / time_step_; }
  Vec3 velocity_to_lattice(const Vec3& si) const { return si * (time_step_ / spacing_); }
  Vec3 velocity_to_si(const Vec3& lattice) const { return lattice * (spacing_ / time_step_); }

  /// Pressure above the reference, Pa, to the density that a pressure face wants (thesis eq 3.30), and back.
  double pressure_to_density_lattice(double pascal) const { return 1 + 3 * pascal / pressure_unit(); }
  double density_lattice_to_pressure(double density_lattice) const {
    return (density_lattice - 1) / 3 * pressure_unit();
  }
  double density_to_si(double lattice) const { return lattice * density_; }

  /// Acceleration (m/s^2) or pressure gradient (Pa/m) to the force on a cell in a step.
  Vec3 acceleration_to_lattice(const Vec3& si) const { return si * (time_step_ * time_step_ / spacing_); }
  Vec3 force_density_to_lattice(const Vec3& newton_per_m3) const {
    return acceleration_to_lattice(newton_per_m3 / density_);
  }
  /// Force in lattice units to newton: rho dx^4/dt^2 (thesis eq 3.36's factor).
  Vec3 force_to_si(const Vec3& lattice) const { return lattice * (pressure_unit() * spacing_ * spacing_); }

  /// One line: dx, dt, tau, Mach, grid Reynolds number, density difference.
  std::string summary() const;
  /// What works but costs accuracy, a sentence with the remedy each; empty if all is well.
  std::vector<std::string> warnings() const;

 private:
  double pressure_unit() const { return density_ * (spacing_ / time_step_) * (spacing_ / time_step_); }
  void check() const;

  double density_, viscosity_;
  bool only_cells_and_steps_ = false;
  double spacing_ = 0, time_step_ = 0, relaxation_time_ = 0;
  double largest_velocity_ = 0, pressure_difference_ = 0;
};

}  // namespace suffuse::lbm
