#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/lbm/boundary.h"
#include "suffuse/lbm/collision_settings.h"
#include "suffuse/lbm/decomposition.h"
#include "suffuse/lbm/instruction_set.h"
#include "suffuse/lbm/partial_solids.h"
#include "suffuse/lbm/row_visitor.h"
#include "suffuse/lbm/walls.h"

namespace suffuse::lbm {

/// What a population is stored as, and computed in. Either way as the deviation from its weight.
enum class Precision { double_precision, float_precision };

struct FluidSettings {
  CollisionSettings collision;
  FaceConditions faces;
  Precision precision = Precision::double_precision;
  std::optional<InstructionSet> instruction_set;  ///< else the widest that the machine can run
};

/// Density and velocity in one cell, lattice units (thesis eqs 3.28, 3.29; the velocity with half of the
/// force).
struct FluidPoint {
  double density = 1;
  Vec3 velocity = Vec3::Zero();
};

/// Of the populations of cells, those in grains included, as they are about to collide.
struct StoredMomentum {
  Vec3 sum = Vec3::Zero();  ///< sum of f_i c_i: a step changes it by what force, solids, faces and walls give
  double magnitude = 0;     ///< sum of its components' magnitudes, cell by cell
};

/// Extremes over all fluid cells of all ranks.
struct FluidExtremes {
  double largest_speed = 0;
  double smallest_density = 1, largest_density = 1;
  bool finite = true;      ///< false as soon as one cell holds a NaN or an infinity
  double stored_mass = 0;  ///< of all cells, those in grains included, beyond rest: conserved in a closed box
  StoredMomentum stored_momentum;
};

class FluidCoreBase;

/// A box of fluid on D3Q19, spread over the ranks of a communicator. Everything in lattice units: cells,
/// steps, and a reference density of one. Cells are numbered over the whole box unless a name says `local`.
///
/// Functions that the whole box takes part in (marked collective) must be called on every rank.
class Fluid {
 public:
  /// At rest at density one. A UserError where settings cannot work. Collective.
  Fluid(const FluidSettings& settings, const Decomposition& decomposition);
  ~Fluid();
  Fluid(Fluid&&) noexcept;
  Fluid& operator=(Fluid&&) noexcept;

  const Decomposition& decomposition() const;
  const FluidSettings& settings() const;
  InstructionSet instruction_set() const;

  /// Sets every cell to the equilibrium of a density and a velocity; restarts the step count at zero.
  void set_equilibrium(const std::function<FluidPoint(const Index3& cell)>& state);

  /// Marks solid cells: `label_of` gives 0 for fluid, 1 to 255 for a solid with that label. It is asked for
  /// every cell of the rank and the cells around it (through periodic faces and mirrored by free-slip ones).
  void set_solids(const std::function<std::uint8_t(const Index3& cell)>& label_of);
  /// Marked as solid, or behind walls.
  bool is_solid(const Index3& cell) const;
  std::uint8_t solid_label(const Index3& cell) const;

  /// Walls between cells from the next step on, instead of those before. What closed cells hold has no
  /// meaning: the caller covers them (use_partial_solids) so that it stays at rest. Collective.
  void set_walls(const Walls& walls);
  /// Is a cell of this rank behind walls? And any cell of any rank?
  bool is_closed(const Index3& cell) const;
  bool has_closed_cells() const;

  /// From now on cells may be covered in part, by whatever the caller writes to the arrays (all zero at
  /// first) between steps. They stay valid as long as the fluid, or until the next call of this function. Not
  /// together with set_solids. A UserError where settings cannot work.
  PartialSolidArrays use_partial_solids(const PartialSolidSettings& settings);

  /// Share of a cell of this rank that solids cover, 0 to 1; a cell of set_solids or behind walls counts as
  /// one.
  double solid_fraction(const Index3& cell) const;

  /// Force per cell and step from the next step on, the same everywhere.
  void set_force(const Vec3& force);
  const Vec3& force() const;

  /// Another operator or eddy viscosity from the next step on; relaxation time and equilibrium must stay what
  /// they were, since the populations are of them.
  void set_collision(const CollisionSettings& collision);

  /// New values for the faces from the next step on; the kinds must stay what they were.
  void set_faces(const FaceConditions& faces);

  /// Advances by one step. Collective.
  void step();
  /// The same, bit for bit, with somebody looking on at partly covered cells.
  void step(RowVisitor& visitor);
  int rows_per_block() const;
  void run(long steps) {
    for (long n = 0; n < steps; ++n) step();
  }
  long steps() const;

  /// Reads and writes back every population of this rank, unchanged, with one multiplication and one addition
  /// each: the fastest that the memory allows, for comparison with a step.
  void bare_update();

  /// Density and velocity of a cell of this rank; a solid cell is at rest at density one, a partly covered
  /// one moves at (1-B) u + B us.
  FluidPoint at(const Index3& cell) const;

  /// Visits the cells of this rank with what `at` and `solid_fraction` give for them, to the last digit:
  /// several times faster than one by one. What the populations of this rank hold comes with it.
  using PointVisitor =
      std::function<void(const Index3& cell, const FluidPoint& point, double solid_fraction)>;
  StoredMomentum for_each_point(const PointVisitor& visit) const;

  /// The population that a cell of this rank is about to collide, less its weight.
  double population(int direction, const Index3& cell) const;
  void set_population(int direction, const Index3& cell, double value);

  /// Which of its two storage forms the fluid is in, and from which step on to count; what a checkpoint must
  /// keep.
  bool at_odd_step() const;
  void set_progress(long steps, bool at_odd_step);

  /// Force of the fluid on the solid cells with a label in the last step, gauge pressure. Collective.
  Vec3 solid_force(std::uint8_t label) const;

  /// Sum of (density - 1) over the fluid cells, and of the momentum (half of the force included, of the
  /// solids' exchange nothing). Collective.
  double mass_deviation() const;
  Vec3 momentum() const;
  FluidExtremes extremes() const;

  /// Memory that this rank holds for populations and labels, bytes.
  std::size_t bytes() const;

 private:
  std::unique_ptr<FluidCoreBase> core_;
};

}  // namespace suffuse::lbm
