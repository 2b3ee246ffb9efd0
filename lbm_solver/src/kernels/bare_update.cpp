// Compiled once for each instruction set: what the memory allows, see BareUpdate.
#include "cell_pack.h"
#include "kernel_tables.h"

namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE {

namespace {

template <class T>
void update(const KernelCall<T>& call) {
  constexpr int width = kPackWidth<T>;
  for (int z = call.begin_z; z < call.end_z; ++z)
    for (int y = call.begin_y; y < call.end_y; ++y) {
      const std::ptrdiff_t row = call.row_pitch * y + call.plane_pitch * z;
      for (int x = 0; x + width <= call.cells_x; x += width) {
#pragma GCC unroll 19
        for (int i = 0; i < kDirections; ++i) {
          T* place = call.place[i] + row + x;
          store<T>(place, load<T>(place) * call.even_rate + call.force[0]);
        }
      }
    }
}

}  // namespace

void bare_update(const KernelCall<double>& call) {
  update(call);
}
void bare_update(const KernelCall<float>& call) {
  update(call);
}

}  // namespace suffuse::lbm::SUFFUSE_KERNEL_NAMESPACE
