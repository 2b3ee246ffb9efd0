#pragma once

#include <cstddef>
#include <vector>

#include "suffuse/coupling/settings.h"
#include "suffuse/lbm/decomposition.h"

namespace suffuse::coupling {

/// Writes which part of each cell is covered and how fast it moves, for the collision to read; and adds up
/// afterwards what the cells of each sphere received.
///
/// Planes of cells (constant z) in which no sphere moved are left as they are. Any number of spheres may
/// share a cell: where their fractions add up to more than one they shrink in proportion, and the exchange of
/// a cell is shared in proportion to the strengths (fraction times coefficient). Fractions are multiples of
/// 2^-22 and strengths with coefficients of 2^-18, so that their sums are exact in any order.
class SolidMapping {
 public:
  SolidMapping(const SolidSettings& settings, lbm::InstructionSet instruction_set,
               const lbm::PartialSolidArrays& arrays, const lbm::CellBox& local_box);

  /// Brings the cells up to date. Returns how many of the spheres moved (all of them after one came, went or
  /// changed its place in the list).
  std::size_t update(const std::vector<LatticeSphere>& spheres);

  /// Sum over the cells of sphere n of the last update; zero for one that reaches no cell of this rank.
  LatticeLoad load_of(std::size_t n, double relaxation_time) const;

  /// Sum of the fractions of sphere n in this rank's cells: its volume there, in cells.
  double volume_of(std::size_t n) const;

  /// Solids' volume times their velocity in a cell of this rank (numbered over the whole box), cells per
  /// step; fractions that add up to more than one shrink in proportion.
  Vec3 solid_flux(const lbm::Index3& cell) const;

  /// What the fractions of this rank's cells add up to beyond one, cells.
  double overlap() const;

  std::size_t spheres() const { return mapped_.size(); }
  /// The order in which loads are read fastest: along z.
  const std::vector<std::size_t>& order() const { return order_; }
  std::size_t bytes() const;

 private:
  void place(const LatticeSphere& sphere, MappedSphere& mapped) const;
  bool same_list(const std::vector<LatticeSphere>& spheres) const;
  bool moved(const LatticeSphere& now, const LatticeSphere& then) const;
  void mark(const MappedSphere& mapped, std::vector<char>& planes) const;
  void give_entries();
  void sort_along_z();
  void write_planes(const std::vector<char>& dirty);
  void clear_plane(int z) const;

  SolidSettings settings_;
  lbm::InstructionSet instruction_set_;
  lbm::PartialSolidArrays arrays_;
  lbm::CellBox box_;
  std::vector<MappedSphere> mapped_;
  std::vector<std::size_t> order_;
  std::vector<float> entries_;
};

}  // namespace suffuse::coupling
