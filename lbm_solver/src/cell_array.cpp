#include "suffuse/lbm/cell_array.h"

namespace suffuse::lbm {

ArrayPart cells_of(const Decomposition& decomposition) {
  ArrayPart part;
  for (const std::size_t a : {2, 1, 0}) {
    part.whole.push_back(static_cast<std::size_t>(decomposition.cells()[a]));
    part.offset.push_back(static_cast<std::size_t>(decomposition.local_box().lo[a]));
    part.count.push_back(static_cast<std::size_t>(decomposition.local_box().extent(static_cast<int>(a))));
  }
  return part;
}

}  // namespace suffuse::lbm
