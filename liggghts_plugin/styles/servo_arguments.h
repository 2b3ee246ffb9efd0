#pragma once

#include <cstdint>

#include "laws/stress_servo.h"
#include "style_support.h"

namespace suffuse {

enum class MeanDiameter { mass, number, given };

/// What the words of a `fix stress/servo` line say.
struct ServoArguments {
  servo::Settings settings;
  std::int64_t every = 50;        ///< steps between control steps, the most
  bool every_given = false;       ///< then always so many
  bool approach_given = false;    ///< else settings.approach_share follows the grains' friction
  std::int64_t window_steps = 0;  ///< of `static`; 0: from the Rayleigh time
  double progress_every = 30;     ///< s of wall clock between progress lines; 0: none
  MeanDiameter diameter_kind = MeanDiameter::mass;
  double diameter = 0;  ///< m, if given
};

/// Reads them; throws UserError for whatever is wrong.
ServoArguments read_servo_arguments(ArgumentReader& reader);

}  // namespace suffuse
