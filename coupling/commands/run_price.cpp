#include "run_price.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../liggghts/fluid_box.h"
#include "../liggghts/instance.h"
#include "lbm_run.h"
#include "run_effects.h"
#include "suffuse/common/error.h"
#include "suffuse/lbm/whole_cells.h"

namespace suffuse::coupling {

namespace {

void require_cells_of_grains(double spacing, const LiggghtsPort::Summary& grains) {
  constexpr double least = kLeastDiametersOfCell, rounding = 1e-9;
  if (grains.grains > 0 && spacing < least * grains.sauter_diameter * (1 - rounding))
    throw_user_error({"lbm lattice", "spacing", fmt::format("{:g} m", spacing),
                      fmt::format("be at least {:g} mean diameters, {:.3g} m, with `lbm method averaged`",
                                  least, least * grains.sauter_diameter),
                      fmt::format("about three, {:.2g} m, is usual", 3 * grains.sauter_diameter)});
}

/// How often a step monitors and guards go through all cells.
double sweeps_of(const LbmRequest& request, double fluid_step) {
  double sweeps = 1. / LbmRun::kCheckEvery;
  for (const MonitorRequest& monitor : request.monitors)
    sweeps = std::max(sweeps, std::min(1., fluid_step / monitor.every));
  return sweeps;
}

}  // namespace

CoupledSettings settings_for_grains(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& request,
                                    const LiggghtsPort& port) {
  CoupledSettings coupled = settings_now(request, lmp);
  if (coupled.averaged) require_cells_of_grains(lbm::Units(coupled.units).spacing(), port.summary());
  return coupled;
}

lbm::Decomposition decomposition_of(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& request,
                                    const LiggghtsPort& port, Vec3& low) {
  const double spacing = lbm::Units(request.units).spacing();
  const FluidBox box = fluid_box(lmp, port, request.region);
  low = box.low;
  return port.decomposition(box.low, spacing, lbm::whole_cells(box.size, spacing, "lbm lattice"));
}

int substeps_for(const LbmRequest& request, const LiggghtsPort& port) {
  const double fluid_step = lbm::Units(request.units).time_step(), largest = port.time_step();
  constexpr double most = 1e6;
  if (!(largest > 0) || fluid_step / largest > most)
    throw_user_error(
        {"lbm run", "timestep", fmt::format("{:g} s", largest),
         fmt::format("be > 0 and at least a millionth of the fluid's step, {:.6g} s", fluid_step),
         "`dem_timestep rayleigh 0.15` sets what the contacts allow"});
  const int needed = std::max(1, static_cast<int>(std::ceil(fluid_step / largest * (1 - 1e-9))));
  const int asked = request.substeps;
  if (asked > 0 && asked < needed)
    throw_user_error({"lbm couple", "substeps", fmt::format("{}", asked),
                      fmt::format("be at least {}: a fluid step is {:.6g} s, the DEM's `timestep` {:.6g} s",
                                  needed, fluid_step, largest),
                      "use `substeps auto`"});
  return asked > 0 ? asked : needed;
}

RunPrice price_of_run(LAMMPS_NS::LAMMPS* lmp, const LbmRequest& request, LiggghtsPort& port) {
  RunPrice price;
  price.settings = settings_for_grains(lmp, request, port);
  price.settings.effects = RunEffects().start(price.settings, port, lmp, "");
  port.check_box(price.settings.fluid.faces);
  Vec3 low;
  const lbm::Decomposition parts = decomposition_of(lmp, request, port, low);
  price.cells = parts.cells();
  price.settings.substeps = substeps_for(request, port);
  const double step = lbm::Units(price.settings.units).time_step();
  price.costs =
      trial_costs(price.settings, parts, low, port, step / price.settings.substeps, sweeps_of(request, step));
  const PastRun past = port.past_run();
  price.grains_known = past.grain_steps > 0;
  const auto grains = static_cast<double>(port.summary().grains);
  if (grains > 0 && port.anything_moves())
    price.costs.grains = grain_seconds(parts.ranks(), past, price.settings.substeps, grains);
  price.water = parts.ranks() * price.costs.water() / step;
  price.grains = parts.ranks() * price.costs.grains / step;
  return price;
}

}  // namespace suffuse::coupling
