#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "suffuse/lbm/fluid.h"

namespace suffuse::lbm {

/// The same fluid, slow and plain: one rank, two grids, double, whole populations, one cell and one direction
/// at a time, formulas as they are printed. The oracle that the fast kernels are held against; nothing runs
/// on it.
class ReferenceFluid {
 public:
  ReferenceFluid(const FluidSettings& settings, const Index3& cells);

  void set_solids(const std::function<std::uint8_t(const Index3& cell)>& label_of);
  void use_partial_solids(const PartialSolidSettings& settings) { partial_ = settings; }
  void set_partial_solid(const Index3& cell, const PartialSolidCell& solids) {
    solids_[index(cell)] = solids;
  }
  /// Momentum that the fluid handed to the solids of a cell in the last step.
  Vec3 exchange(const Index3& cell) const { return exchange_[index(cell)]; }
  void set_force(const Vec3& force) { force_ = force; }
  void set_faces(const FaceConditions& faces) { settings_.faces = faces; }

  /// A population less its weight.
  double population(int direction, const Index3& cell) const;
  void set_population(int direction, const Index3& cell, double value);

  FluidPoint at(const Index3& cell) const;
  Vec3 solid_force(std::uint8_t label) const;
  void step();

 private:
  using CellPopulations = std::array<double, 19>;

  std::size_t index(const Index3& cell) const;
  FluidPoint after_collision(const Index3& cell) const;
  /// What diagonal links beside `straight` do not push into a cell of a moving velocity face, as they meet a
  /// wall or another velocity as well.
  double lost_at_edges(const Index3& cell, int straight) const;
  double entering(const Index3& cell, int direction);

  FluidSettings settings_;
  Index3 cells_;
  Vec3 force_ = Vec3::Zero();
  std::vector<CellPopulations> before_, after_;
  std::vector<std::uint8_t> labels_;
  std::optional<PartialSolidSettings> partial_;
  std::vector<PartialSolidCell> solids_;
  std::vector<Vec3> exchange_;
  std::array<Vec3, 256> solid_forces_;
};

/// One collision of one cell: `populations` are whole (weights included). Exposed for tests of single
/// operators.
std::array<double, 19> reference_collision(const std::array<double, 19>& populations,
                                           const CollisionSettings& settings, const Vec3& force);

struct PartialCollision {
  std::array<double, 19> populations;
  Vec3 exchange = Vec3::Zero();  ///< momentum handed to the solids
};

/// The same where solids cover a part of the cell.
PartialCollision reference_partial_collision(const std::array<double, 19>& populations,
                                             const CollisionSettings& settings, const Vec3& force,
                                             const PartialSolidSettings& partial,
                                             const PartialSolidCell& solids);

}  // namespace suffuse::lbm
