#pragma once

#include "suffuse/lbm/partial_solids.h"

namespace suffuse::lbm {

/// Rows begin_y <= y < end_y of plane z of a sub-box (numbered from its low corner).
struct RowBlock {
  int z, begin_y, end_y;
};

/// Called around the sweep of each block of rows of a step, while what it writes or reads is in the cache.
/// Every row of the sub-box is in one block of a step; blocks begin at multiples of Fluid::rows_per_block,
/// and come in any order.
class RowVisitor {
 public:
  virtual ~RowVisitor() = default;

  /// May write the fractions, strengths and momenta of the block's cells.
  virtual void before(const RowBlock& block) = 0;

  /// May read what these cells exchanged; `exchange` is indexed like PartialSolidArrays, for the cells of the
  /// block only, and valid during the call.
  virtual void after(const RowBlock& block, const ExchangeArrays& exchange) = 0;

  /// If not, `after` is not called, and the exchange of all cells can be read from PartialSolidArrays when
  /// the step is over, as without a visitor; if so, it is not kept there.
  virtual bool reads_exchange() const = 0;
};

}  // namespace suffuse::lbm
