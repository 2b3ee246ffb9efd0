#pragma once

// Which law the contacts of a script follow, with its parameters by atom type, and the time step that it
// allows each grain. Formulas: micromechanics/dem_time_step.h.

#include <string>
#include <vector>

#include "suffuse/micromechanics/dem_time_step.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse {

/// The normal law of `pair_style gran` and what the script says of its materials.
class PairLaw {
 public:
  enum class Kind { hertz, hooke, hooke_stiffness, other };

  /// Reads the pair style, `fix property/global`, and which types grains and walls (`fix wall/gran`) have.
  /// Throws UserError in the name of `who` where a value is missing. Collective. LIGGGHTS's styles have to be
  /// initialised (`LAMMPS::init`).
  static PairLaw of(LAMMPS_NS::LAMMPS* lmp, const std::string& who);

  Kind kind() const { return kind_; }
  bool is_linear() const { return kind_ == Kind::hooke || kind_ == Kind::hooke_stiffness; }
  const std::string& name() const { return name_; }

  /// What `critical_time` is, in words: "Rayleigh time" or "contact duration".
  const char* time_name() const { return is_linear() ? "contact duration" : "Rayleigh time"; }

  /// Material of a grain of this type (1 …) and size. E and ν are 0 where `hooke/stiffness` does without.
  micromechanics::GrainMaterial material(int type, double radius, double density) const;

  /// The time that a step has to resolve for a grain, s. Hertz (and laws not known here): its Rayleigh time.
  /// Linear springs: the contact duration with a grain of its own mass and size, or with a wall, of whichever
  /// of the sample's materials is stiffest against it.
  double critical_time(int type, double radius, double density) const;

  /// critical_time ~ density^this.
  double density_exponent() const { return kind_ == Kind::hooke ? 0.4 : 0.5; }

  /// √(m/K) of thesis eqs 3.3 and 3.4, K at the mean stress for Hertz, s.
  double oscillation_time(int type, double radius, double density, double mean_stress) const;

  /// Diameter over typical overlap at the mean stress.
  double stiffness_number(int type, double radius, double density, double mean_stress) const;

 private:
  double hooke_spring(int type, int partner, double mass, double radius) const;
  double spring_of_like_grains(int type, double radius, double density) const;

  Kind kind_ = Kind::other;
  std::string name_;
  std::vector<double> youngs_modulus_, poisson_ratio_;  // by type - 1
  std::vector<std::vector<double>> spring_;             // of hooke/stiffness
  double characteristic_velocity_ = 0;
  std::vector<bool> grains_have_, walls_have_;  // by type - 1
};

/// The grain that allows the smallest time step.
struct CriticalGrain {
  double time = 0;              ///< its critical_time, s
  double oscillation_time = 0;  ///< the smallest of all grains, not necessarily of this one, s
  double stiffness_number = 0;  ///< likewise
  double radius = 0;            ///< m
  double inertial_density = 0;  ///< mass that integration uses over volume, kg/m³
  double true_density = 0;      ///< kg/m³
  int type = 0;
};

/// Over all grains. Collective; throws nothing; `time` is infinite without grains.
CriticalGrain critical_grain(LAMMPS_NS::LAMMPS* lmp, const PairLaw& law, double mean_stress);

}  // namespace suffuse
