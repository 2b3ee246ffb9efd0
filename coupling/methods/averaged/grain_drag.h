#pragma once

#include "averaged/grain_shares.h"
#include "suffuse/coupling/methods/averaged_flow.h"

namespace suffuse::coupling::averaged {

/// How much of its own share a grain finds in the solid fraction around it: all of it in a dilute cloud,
/// nearly nothing in a packing, whose other grains keep away as far as it reaches. Compressibility of hard
/// spheres after Carnahan and Starling (docs key: carnahanstarling1969).
double own_share(double phi);

/// z of a grain from `drag`, that of the closure for the undisturbed water; `share` of own_share,
/// `resistance` of the grains in a volume, kg/(m^3 s). At most twice `drag`.
double drag_of_mean_velocity(double drag, double share, double mu, double spacing, double cell_reynolds,
                             double resistance);

/// Loads are constant over a step and answer a change of a grain's velocity in the next. Water that cannot
/// but stream back past the grains makes their drag 1/e^2 times as large, and has the inertia rho V phi/e.
/// With shares b = drag x step and c of that inertia of the grain's own, the motion is stable for b + 2 c <
/// 2; what is added here leaves 1.4. It is added to the inertia alone: weight, drag at rest and terminal
/// velocities stay, and a grain that would follow the water within a step does so within some.
double inertia_for_step(const PlacedGrain& grain, double e, const AveragedFlowSetup& setup);

}  // namespace suffuse::coupling::averaged
