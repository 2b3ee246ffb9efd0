#pragma once

#include "suffuse/coupling/methods/drag_laws.h"

namespace suffuse::coupling {

/// Mean (Sauter) diameters a cell must be wide at least: closures are means over several grains.
inline constexpr double kLeastDiametersOfCell = 1.5;

/// `lbm method averaged`
struct AveragedSettings {
  DragLaw drag = DragLaw::beetstra;
  bool graded = true;  ///< drag of unequal spheres by graded_drag_factor
};

}  // namespace suffuse::coupling
