#pragma once

#include <optional>
#include <string>
#include <vector>

#include "prescribed_grains.h"
#include "random_packing.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

/// Spheres in a periodic cube of edge 1.
struct Packing {
  std::vector<Vec3> centres;
  std::vector<double> radii;
  bool array = false;  ///< may be repeated to fit a resolution
};

/// A simple cubic array, or a face-centred one, of the solid fraction c.
Packing array_packing(double c, bool face_centred);

/// sc:PHI, fcc:PHI, pair:PHI:GAP (two spheres, a gap in diameters), random:PHI:COUNT:SEED,
/// spread:PHI:COUNT:SEED:SPREAD, appendix_c:PHI:SEED or gap:PHI:COARSE:SEED:RATIO:FINES_SHARE or
/// grading:PHI:COUNT:FILE:SEED or dump:FILE (a sample as it was dumped). Throws std::runtime_error
/// for another text.
Packing make_packing(const std::string& text);

struct DragRun {
  lbm::SolidOperator solid_operator = lbm::SolidOperator::force;
  lbm::SolidWeighting weighting = lbm::SolidWeighting::viscosity_independent;
  lbm::CollisionOperator collision = lbm::CollisionOperator::trt;
  FractionMethod fraction = FractionMethod::exact;
  double magic = 0.1875;  ///< of trt
  double relaxation_time = 1;
  double coefficient = 0;             ///< 0: automatic
  std::optional<CoefficientLaw> law;  ///< of the automatic one, else the operator's
  double offset = 0.3;                ///< of the packing from the lattice, cells
  double water = 0;                   ///< layers without grains below and above (z), in box lengths
  bool through = false;               ///< flow along z, else along x
  bool oblique = false;               ///< a packing that moves does so along (1, 1, 1), else along x
  bool single = false;                ///< single precision
  bool movable = false;               ///< coefficients as of grains that may move (largest_coefficient)
};

struct DragResult {
  double phi = 0, diameter = 0;  ///< as run; Sauter, cells
  double drag = 0;               ///< K
  double crowding = 0;           ///< mean D s/6 of CoefficientLaw
  int cells = 0;                 ///< edge of the box
  long steps = 0;
};

/// Held spheres in Stokes flow driven by a pressure gradient until it is steady, in a box of a whole number
/// of cells with the Sauter diameter (cells) nearest to the one asked for. K is the drag on a sphere over
/// 6 pi mu a U with the Sauter radius and the superficial velocity: permeability/d^2 = 1/(18 phi K).
DragResult drag_of(const Packing& packing, double diameter, const DragRun& run);

struct MovingResult {
  bool stable = false;  ///< false: speeds passed 0.5, or were not finite
  double held = 0;      ///< K of the held packing
  double drag = 0;      ///< K from the flow relative to the grains
  double noise = 0;     ///< rms of one grain's force over its mean
};

/// The whole packing moved at `speed` (cells a step), fluid with it, with a superficial velocity relative to
/// it of about `flow` along x.
MovingResult moving_drag_of(const Packing& packing, double diameter, const DragRun& run, double speed,
                            double flow);

}  // namespace suffuse::coupling
