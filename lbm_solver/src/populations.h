#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "kernel_call.h"
#include "suffuse/lbm/index3.h"

namespace suffuse::lbm {

/// Memory for one sub-box: 19 arrays of populations less their weights, x fastest, with one ghost cell
/// around.
///
/// A row's two ghost cells share the padding between rows, which is at least two and at most nine cells.
/// Slots start at different offsets within a page, so that the 19 streams of a sweep do not compete for one
/// cache set.
template <class T>
class Populations {
 public:
  explicit Populations(const Index3& cells) : cells_(cells) {
    row_pitch_ = (cells[0] + 2 + 7) / 8 * 8;
    plane_pitch_ = row_pitch_ * (cells[1] + 2);
    const std::size_t page = 4096 / sizeof(T), line = 64 / sizeof(T);
    // Ghost planes, a guard for whole-register loads past the last cell, rounded up to pages; then a few
    // lines more.
    const std::size_t needed = static_cast<std::size_t>(plane_pitch_ * (cells[2] + 2)) + 4 * line;
    slot_stride_ = (needed + page - 1) / page * page + 3 * line;
    constexpr std::size_t huge_page = std::size_t{1} << 21;
    bytes_ = slot_stride_ * kDirections * sizeof(T);
    void* block = std::aligned_alloc(huge_page, (bytes_ + huge_page - 1) / huge_page * huge_page);
    if (block == nullptr) throw std::bad_alloc();
    memory_.reset(static_cast<T*>(block));
    madvise(block, bytes_, MADV_HUGEPAGE);  // an answer of "no" changes nothing but speed
    std::memset(block, 0, bytes_);
    // The first inner cell of every row lies on a cache line (double) or half a line (float).
    first_ = static_cast<std::ptrdiff_t>(line) + row_pitch_ + plane_pitch_;
  }

  T* slot(int direction) {
    return memory_.get() + slot_stride_ * static_cast<std::size_t>(direction) + first_;
  }
  const T* slot(int direction) const {
    return memory_.get() + slot_stride_ * static_cast<std::size_t>(direction) + first_;
  }
  std::ptrdiff_t index(int x, int y, int z) const { return x + row_pitch_ * y + plane_pitch_ * z; }
  std::ptrdiff_t offset_of(int direction) const {
    return index(kVelocity[direction][0], kVelocity[direction][1], kVelocity[direction][2]);
  }

  const Index3& cells() const { return cells_; }
  std::ptrdiff_t row_pitch() const { return row_pitch_; }
  std::ptrdiff_t plane_pitch() const { return plane_pitch_; }
  std::size_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(T* block) const { std::free(block); }
  };
  Index3 cells_;
  std::ptrdiff_t row_pitch_ = 0, plane_pitch_ = 0, first_ = 0;
  std::size_t slot_stride_ = 0, bytes_ = 0;
  std::unique_ptr<T, Free> memory_;
};

/// One byte a cell with the layout of Populations, ghost cells included: 0 is fluid.
class CellLabels {
 public:
  CellLabels(const Index3& cells, std::ptrdiff_t row_pitch, std::ptrdiff_t plane_pitch)
      : first_(row_pitch + plane_pitch + 64),
        row_pitch_(row_pitch),
        plane_pitch_(plane_pitch),
        labels_(static_cast<std::size_t>(plane_pitch * (cells[2] + 2)) + 192, 0) {}
  std::uint8_t* data() { return labels_.data() + first_; }
  const std::uint8_t* data() const { return labels_.data() + first_; }
  std::uint8_t& at(int x, int y, int z) { return data()[x + row_pitch_ * y + plane_pitch_ * z]; }
  std::uint8_t at(int x, int y, int z) const { return data()[x + row_pitch_ * y + plane_pitch_ * z]; }
  std::size_t bytes() const { return labels_.size(); }

 private:
  std::ptrdiff_t first_, row_pitch_, plane_pitch_;
  std::vector<std::uint8_t> labels_;
};

/// One value a cell with the layout of Populations, without ghost planes: for what a collision reads or
/// writes in its own cells only. `number` tells several such arrays apart: they start at different offsets
/// within a page, and rows on half a cache line at least.
template <class V>
class CellValues {
 public:
  CellValues(const Index3& cells, std::ptrdiff_t row_pitch, std::ptrdiff_t plane_pitch, std::size_t number)
      : first_(kGuard + number * 5 * kLine),
        count_(static_cast<std::size_t>(plane_pitch * (cells[2] - 1) + row_pitch * cells[1]) + first_ +
               kGuard) {
    void* block = std::aligned_alloc(4096, (count_ * sizeof(V) + 4095) / 4096 * 4096);
    if (block == nullptr) throw std::bad_alloc();
    std::memset(block, 0, count_ * sizeof(V));
    values_.reset(static_cast<V*>(block));
  }
  V* data() { return values_.get() + first_; }
  const V* data() const { return values_.get() + first_; }
  std::size_t bytes() const { return count_ * sizeof(V); }

 private:
  struct Free {
    void operator()(V* block) const { std::free(block); }
  };
  static constexpr std::size_t kLine = 64 / sizeof(V), kGuard = 64;
  std::size_t first_, count_;
  std::unique_ptr<V, Free> values_;
};

}  // namespace suffuse::lbm
