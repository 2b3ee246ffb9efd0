#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

/// `lbm guard`: how far a run may go before it is ended. Warnings come at the share `kWarnShare` of each
/// limit.
struct GuardLimits {
  double density = 0.5;       ///< departure of a cell's density from rest, as a share
  double motion = 0.5;        ///< cells that a grain passes in a fluid step
  double overlap = 0.1;       ///< share of the grains' volume that lies in other grains
  double mass = 1e-3;         ///< change of the mass in a closed box, as a share
  double momentum = 1e-3;     ///< what is missing of it, as a share of all that was handed over
  bool stop_if_lost = false;  ///< end the run where a grain leaves the box, rather than warn
};
inline constexpr double kWarnShare = 0.5;

/// Momentum along those axes along which no face or wall takes any up, lattice units; zero along others.
struct MomentumBudget {
  Vec3 surplus = Vec3::Zero();  ///< of the populations over what force and grains gave
  double handed_over = 0;       ///< sum of the magnitudes of what force and grains gave, since the first step
  double stored = 0;            ///< sum of the magnitudes of what the cells hold
  long steps_unknown = 0;       ///< steps so far in which nobody knows what the grains took
};

/// What is looked at, of all ranks.
struct GuardReading {
  lbm::FluidExtremes fluid;
  double mach_limit = 0.3;
  double fastest_grain = 0;  ///< m/s; not finite where a grain's velocity is not
  double overlap = 0;        ///< share of the grains' volume
  std::int64_t lost_grains = 0;
  /// Mass beyond rest of all populations and the mass at rest, lattice units; none where faces let mass in or
  /// out.
  std::optional<double> stored_mass;
  double mass_at_rest = 1;
  std::optional<MomentumBudget> momentum;  ///< none where faces or walls take up all components
};

/// The parts of a reading that are budgets of the water, from a sweep that has just been made. Collective.
void read_budgets(GuardReading& reading, const CoupledSimulation& simulation);

/// Watches over one run: each quantity is warned of once, with its number and place, and ends the run beyond
/// its limit. All ranks see the same reading and do the same.
class RunGuards {
 public:
  RunGuards(const GuardLimits& limits, const CoupledSimulation& simulation)
      : limits_(limits), simulation_(simulation) {}

  /// Quantities that have been warned of: one that a saved state brings is not warned of again.
  const std::set<std::string>& warned() const { return warned_; }
  void set_warned(std::set<std::string> warned) { warned_ = std::move(warned); }

  /// New warnings, a line each; LostRun beyond a limit. Collective.
  std::vector<std::string> check(const GuardReading& reading);

 private:
  struct Finding {
    std::string name;  ///< of the quantity
    double value, limit;
    std::string number;  ///< the value as text, with what it is
    std::string rule, remedy;
  };
  std::vector<Finding> findings(const GuardReading& reading);
  Finding momentum_finding(const MomentumBudget& now);
  std::string place_of(const std::string& name) const;

  GuardLimits limits_;
  const CoupledSimulation& simulation_;
  std::optional<double> first_mass_;
  std::optional<MomentumBudget> first_momentum_;
  std::set<std::string> warned_;
};

}  // namespace suffuse::coupling
