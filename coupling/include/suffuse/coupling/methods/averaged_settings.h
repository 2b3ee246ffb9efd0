#pragma once

#include "suffuse/coupling/methods/drag_laws.h"

namespace suffuse::coupling {

/// `lbm method averaged`
struct AveragedSettings {
  DragLaw drag = DragLaw::beetstra;
  bool graded = true;  ///< drag of unequal spheres by graded_drag_factor
};

}  // namespace suffuse::coupling
