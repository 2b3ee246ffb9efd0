#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "suffuse/coupling/settings.h"
#include "suffuse/lbm/decomposition.h"
#include "suffuse/lbm/row_visitor.h"

namespace suffuse::coupling {

struct SliceList;
struct SliceNotes;

/// Writes which part of each cell is covered and how fast it moves, for the collision to read; and adds up
/// afterwards what the cells of each sphere received.
///
/// Both can be done block of rows by block of rows, as the fluid sweeps them (lbm::RowVisitor): what one side
/// writes is then in the cache when the other reads it. Planes of cells (constant z) in which no sphere moved
/// are left as they are. Any number of spheres may share a cell: where their fractions add up to more than
/// one they shrink in proportion, and the exchange of a cell is shared in proportion to the strengths
/// (fraction times the coefficients of sphere and pore). Fractions are multiples of 2^-22 and strengths with
/// coefficients of 2^-14, so that their sums are exact in any order.
class SolidMapping {
 public:
  SolidMapping(const SolidSettings& settings, lbm::InstructionSet instruction_set,
               const lbm::PartialSolidArrays& arrays, const lbm::CellBox& local_box, int rows_per_block = 16);

  /// Where the spheres are now. Returns how many of them moved (all of them after one came, went or changed
  /// its place in the list). Cells are not written yet.
  std::size_t place(const std::vector<LatticeSphere>& spheres);
  /// The next `place` takes all spheres for new ones.
  void forget() { placed_.clear(); }

  /// What the pores add to the spheres' coefficients in each cell, laid out as the fractions; null: nothing.
  /// With own_coefficients only. All cells wait to be written then.
  void set_pore_coefficients(const float* coefficients);

  /// Cells behind walls (one value each, x fastest; empty: none) are covered whole by something at rest,
  /// whatever spheres reach into them. All cells wait to be written then.
  void set_closed(const std::vector<std::uint8_t>& closed);

  /// Whether any cell waits to be written.
  bool is_stale() const { return stale_; }
  /// Brings the cells of one block up to date, if they are not. `finish_writing` follows when all blocks have
  /// been.
  void write_rows(const lbm::RowBlock& block);
  void finish_writing();
  /// Brings all cells up to date.
  void write();
  /// `place` and `write`.
  std::size_t update(const std::vector<LatticeSphere>& spheres);

  /// The sums over the cells of each sphere: `sum_rows` adds one block's, in between the others; `sum` does
  /// everything for all cells of the rank.
  void begin_loads(double relaxation_time);
  void sum_rows(const lbm::RowBlock& block, const lbm::ExchangeArrays& exchange);
  void sum(double relaxation_time);
  /// By sphere, as in the last `place`; zero for one that reaches no cell of this rank.
  const std::vector<LatticeLoad>& loads() const { return loads_; }

  /// Solids' volume times their velocity in a cell of this rank (numbered over the whole box), cells per
  /// step; fractions that add up to more than one shrink in proportion.
  Vec3 solid_flux(const lbm::Index3& cell) const;

  /// What the fractions of this rank's cells add up to beyond one, cells.
  double overlap() const;

  std::size_t spheres() const { return mapped_.size(); }
  std::size_t bytes() const;

 private:
  void set_place(const LatticeSphere& sphere, MappedSphere& mapped) const;
  bool same_list(const std::vector<LatticeSphere>& spheres) const;
  bool moved(const LatticeSphere& now, const LatticeSphere& then) const;
  void mark(const MappedSphere& mapped);
  void order_by_row();
  void list_slices();
  std::size_t number_of(const lbm::RowBlock& block) const;
  SliceList slices_in(const lbm::RowBlock& block) const;
  SliceNotes notes();
  void clear_rows(const lbm::RowBlock& block) const;
  void cover_closed(const lbm::RowBlock& block) const;
  template <class Visit>
  void for_each_block(const Visit& visit) const;

  SolidSettings settings_;
  lbm::InstructionSet instruction_set_;
  lbm::PartialSolidArrays arrays_;
  lbm::CellBox box_;
  int rows_per_block_, blocks_per_plane_;
  std::vector<LatticeSphere> placed_;  ///< as they were when they were placed last
  std::vector<MappedSphere> mapped_;
  std::vector<char> dirty_;  ///< planes whose cells wait to be written
  bool stale_ = false;
  std::vector<int> order_;        ///< of `mapped_` by y_begin
  std::vector<int> first_slice_;  ///< of each block, in `slices_`; one more at the end
  std::vector<int> slices_;       ///< the spheres that may reach it
  std::vector<SliceRows> rows_;   ///< rows and strengths of the slices of one block, which is
  std::vector<float> entries_;
  std::ptrdiff_t noted_block_ = -1;
  std::vector<LatticeLoad> loads_;
  const float* pore_coefficients_ = nullptr;
  std::vector<std::uint8_t> closed_;
  lbm::HeldTerms held_;
};

}  // namespace suffuse::coupling
