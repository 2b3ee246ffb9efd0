#include "command_dem_timestep.h"

#include <fmt/format.h>

#include <string>

#include "comm.h"
#include "domain.h"
#include "lammps.h"
#include "modify.h"
#include "pair_law.h"
#include "style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/dem_time_step.h"
#include "update.h"

using namespace LAMMPS_NS;
using suffuse::throw_user_error;
namespace mm = suffuse::micromechanics;

namespace {

/// Softer than this, overlaps are no longer small against grains (thesis grains at 200 kPa: κ = 3,330).
constexpr double kLeastStiffnessNumber = 1000;
/// Share of the Rayleigh time that the thesis never exceeds (Appendix C: 0.19).
constexpr double kLargestRayleighShare = 0.2;
/// Share of the contact duration t = π √(m/2k) of two like grains that eq 3.4's 0.22 √(m/k) is, 0.0990,
/// rounded.
constexpr double kLargestDurationShare = 0.1;

std::string describe_grain(const suffuse::CriticalGrain& grain) {
  std::string text = fmt::format("diameter {:.4g} m, {:.4g} kg/m3, type {}", 2 * grain.radius,
                                 grain.true_density, grain.type);
  const double factor = grain.inertial_density / grain.true_density;
  if (factor > 1 + 1e-9) text += fmt::format(", inertia scaled by {:.4g}", factor);
  return text;
}

std::string describe(const suffuse::PairLaw& law, const suffuse::CriticalGrain& grain, double pressure,
                     double step, double largest_diameter) {
  const double kappa = grain.stiffness_number;
  std::string text = fmt::format(
      "DEM time step {:.4g} s: {:.3g} of the {} {:.4g} s ({}) of the grain that allows least ({})\n"
      "  {:.3g} of the limit 2 sqrt(m/K) (thesis eq 3.3), {:.3g} of 0.22 sqrt(m/K) (eq 3.4), K at {:.4g} Pa\n"
      "  stiffness number kappa = {} = {:.4g}: typical overlap {:.3g} of a diameter ({:.3g} m for "
      "the largest grain)\n",
      step, step / grain.time, law.time_name(), grain.time, law.name(), describe_grain(grain),
      step / (mm::kSingleSpringFactor * grain.oscillation_time),
      step / (mm::kPackingFactor * grain.oscillation_time), pressure,
      law.is_linear() ? "k/(p' d)" : "(E*/p')^(2/3)", kappa, 1 / kappa, largest_diameter / kappa);
  if (law.kind() == suffuse::PairLaw::Kind::other)
    text +=
        "WARNING: the Rayleigh time is the limit of Hertz's law; that of this pair law is not known here: "
        "check the step by halving it (docs/reference/dem_timestep.md)\n";
  if (kappa < kLeastStiffnessNumber)
    text += fmt::format(
        "WARNING: kappa < {:g}: contacts are softened; porosity, Z and alpha shift "
        "(docs/results/contact_stiffness.md)\n",
        kLeastStiffnessNumber);
  const double largest = law.is_linear() ? kLargestDurationShare : kLargestRayleighShare;
  if (step > largest * (1 + 1e-9) * grain.time)
    text +=
        fmt::format("WARNING: more than {:g} of the {}: energy may drift (docs/reference/dem_timestep.md)\n",
                    largest, law.time_name());
  return text;
}

}  // namespace

void CommandDemTimestep::command(int narg, char** arg) {
  suffuse::ArgumentReader reader("dem_timestep", narg, arg, 0);
  suffuse::require_si_and_three_dimensions(lmp, "dem_timestep");
  double share = 0;
  const std::string mode = reader.word("rayleigh SHARE or check");
  if (mode == "rayleigh")
    share = reader.positive("share of the Rayleigh time");
  else if (mode != "check")
    reader.unknown(mode, "rayleigh, check");
  if (!reader.accept("pressure"))
    throw_user_error({"dem_timestep", "pressure", "missing", "be given",
                      "the mean stress of the run in Pa: `pressure 200e3`"});
  const double pressure = reader.positive("pressure");
  if (!reader.done()) reader.unknown(reader.word("end of line"), "nothing more");
  if (share > 1)
    throw_user_error({"dem_timestep", "share", fmt::format("{:g}", share), "be <= 1", "0.1 is the thesis's"});
  if (domain->box_exist == 0)
    throw_user_error({"dem_timestep", "simulation box", "none", "exist", "insert the grains first"});

  suffuse::require_single_spheres(lmp, "dem_timestep");
  // Properties are looked up as a run does, and masses are those that integration will use.
  suffuse::init_keeping_restart_records(lmp);
  const auto grains = suffuse::grain_statistics(lmp, 1);
  if (grains.count == 0)
    throw_user_error(
        {"dem_timestep", "grains", "0", "exist", "insert them first (run 1 after fix insert/pack)"});
  const auto law = suffuse::PairLaw::of(lmp, "dem_timestep");
  const auto grain = suffuse::critical_grain(lmp, law, pressure);
  if (share > 0) {
    update->dt = share * grain.time;
    for (int i = 0; i < modify->nfix; ++i) modify->fix[i]->reset_dt();
  }
  const double limit = mm::kSingleSpringFactor * grain.oscillation_time;
  if (update->dt > limit)
    throw_user_error({"dem_timestep", "time step", fmt::format("{:.4g} s", update->dt),
                      fmt::format("be below {:.4g} s (thesis eq 3.3)", limit),
                      "dem_timestep rayleigh 0.1 sets a safe one"});
  suffuse::tell(lmp, describe(law, grain, pressure, update->dt, 2 * grains.largest_radius));
}
