#pragma once

#include <vector>

#include "grains/size_class_pairs.h"
#include "neighbor.h"

namespace LAMMPS_NS {

/// LIGGGHTS's neighbour lists, of which those of granular pairs are filled from a grid for each class of
/// sizes
/// (`SizeClassPairs`) instead of one grid of cells as wide as the largest grain.
///
/// Lists have the same pairs as LIGGGHTS's own, each grain's partners in ascending order, in the same pages,
/// with the history of contacts beside them. `neighbor SKIN bin` and `multi` both mean this builder
/// (LIGGGHTS's own `multi` is an empty stub that finds no contact at all); `nsq` is LIGGGHTS's own.
class NeighborBySize : public Neighbor {
 public:
  explicit NeighborBySize(LAMMPS* lmp_in) : Neighbor(lmp_in) {}

  void init() override;
  void build(int topoflag = 1) override;

  /// Grows by one with every set of lists.
  bigint generation() const { return generation_; }

 protected:
  void choose_build(int index, NeighRequest* request) override;

 private:
  void granular_by_size(NeighList* list);
  /// Writes the partners of one grain, and what is known of its contacts; returns how many.
  int list_partners(NeighList* list, int grain, int* partners, int* flags, double* histories) const;

  suffuse::grains::SizeClassPairs pairs_;
  bigint generation_ = 0;
};

}  // namespace LAMMPS_NS
