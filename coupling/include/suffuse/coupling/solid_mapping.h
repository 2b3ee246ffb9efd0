#pragma once

#include <cstddef>
#include <vector>

#include "suffuse/coupling/particle_port.h"
#include "suffuse/coupling/settings.h"
#include "suffuse/lbm/decomposition.h"

namespace suffuse::coupling {

/// A sphere in lattice units: cells of the whole box, cell (0,0,0) from 0 to 1; cells a step.
struct LatticeSphere {
  double position[3];
  double radius = 0;
  double velocity[3];
  double angular_velocity[3];  ///< radians a step
  double coefficient = 1;      ///< k of the viscosity-independent weighting
  int id = 0;
};

/// What a grain's cells handed to it in the last fluid step, lattice units; torque about the grain's centre.
struct LatticeLoad {
  double force[3];
  double torque[3];
};

/// Writes which part of each cell is covered, and how fast it moves, for the collision to read; and adds up
/// afterwards what the cells of each grain received.
///
/// Planes of cells in which no grain moved are left as they are. Any number of grains may share a cell: where
/// their fractions add up to more than one they shrink in proportion, and the exchange of a cell is shared in
/// proportion to the grains' strengths (fraction times coefficient).
class SolidMapping {
 public:
  SolidMapping(const SolidSettings& settings, const lbm::PartialSolidArrays& arrays,
               const lbm::CellBox& local_box);

  /// Brings the cells up to date. Returns how many spheres were mapped anew. Spheres that reach no cell of
  /// this rank are skipped.
  std::size_t update(const std::vector<LatticeSphere>& spheres);

  /// Sums over the cells of sphere n of the last update (zero for one that reaches no cell of this rank).
  LatticeLoad load_of(std::size_t n) const;

  /// Sum of the fractions of sphere n in this rank's cells: its volume, in cells.
  double volume_of(std::size_t n) const;

  std::size_t bytes() const;

 private:
  // see solid_mapping.cpp
};

}  // namespace suffuse::coupling
