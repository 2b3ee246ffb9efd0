#include "command_dem_timestep.h"

#include <fmt/format.h>

#include <string>

#include "comm.h"
#include "domain.h"
#include "lammps.h"
#include "modify.h"
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

std::string describe(const mm::GrainMaterial& grain, double pressure, double step, double largest_diameter) {
  const double oscillation = mm::oscillation_time(grain, pressure);
  const double kappa = mm::stiffness_number(grain, pressure);
  std::string text = fmt::format(
      "DEM time step {:.4g} s: {:.3g} of the Rayleigh time {:.4g} s (smallest grain {:.4g} m)\n"
      "  {:.3g} of the limit 2 sqrt(m/K) (thesis eq 3.3), {:.3g} of 0.22 sqrt(m/K) (eq 3.4), K at {:.4g} Pa\n"
      "  stiffness number kappa = (E*/p')^(2/3) = {:.4g}: typical overlap {:.3g} of a diameter ({:.3g} m for "
      "the largest grain)\n",
      step, step / mm::rayleigh_time(grain), mm::rayleigh_time(grain), grain.diameter,
      step / (mm::kSingleSpringFactor * oscillation), step / (mm::kPackingFactor * oscillation), pressure,
      kappa, 1 / kappa, largest_diameter / kappa);
  if (kappa < kLeastStiffnessNumber)
    text += fmt::format(
        "WARNING: kappa < {:g}: contacts are softened (E = {:.3g} Pa); porosity, Z and alpha shift, see the "
        "page on stiffness\n",
        kLeastStiffnessNumber, grain.youngs_modulus);
  if (step > kLargestRayleighShare * mm::rayleigh_time(grain))
    text += fmt::format("WARNING: more than {:g} of the Rayleigh time: energy may drift\n",
                        kLargestRayleighShare);
  return text;
}

}  // namespace

void CommandDemTimestep::command(int narg, char** arg) {
  suffuse::ArgumentReader reader("dem_timestep", narg, arg, 0);
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

  lmp->init();  // properties are looked up as a run does
  const auto elastic = suffuse::elastic_constants(lmp);
  const auto grains = suffuse::grain_statistics(lmp, 1);
  if (grains.count == 0)
    throw_user_error(
        {"dem_timestep", "grains", "0", "exist", "insert them first (run 1 after fix insert/pack)"});
  if (!elastic.known)
    throw_user_error({"dem_timestep", "youngsModulus", "unknown", "be defined",
                      "write fix property/global for youngsModulus and poissonsRatio"});
  const mm::GrainMaterial smallest{elastic.youngs_modulus, elastic.poisson_ratio, grains.mean_density,
                                   2 * grains.smallest_radius};
  if (share > 0) {
    update->dt = share * mm::rayleigh_time(smallest);
    for (int i = 0; i < modify->nfix; ++i) modify->fix[i]->reset_dt();
  }
  const double limit = mm::kSingleSpringFactor * mm::oscillation_time(smallest, pressure);
  if (update->dt > limit)
    throw_user_error({"dem_timestep", "time step", fmt::format("{:.4g} s", update->dt),
                      fmt::format("be below {:.4g} s (thesis eq 3.3)", limit),
                      "dem_timestep rayleigh 0.1 sets a safe one"});
  const std::string text = describe(smallest, pressure, update->dt, 2 * grains.largest_radius);
  suffuse::tell(lmp, text);
}
