#pragma once

#include <memory>
#include <vector>

#include "populations.h"
#include "suffuse/lbm/row_visitor.h"

namespace suffuse::lbm {

/// The arrays behind PartialSolidArrays, with the layout of the populations.
template <class T>
class PartialSolidStore {
 public:
  PartialSolidStore(const Populations<T>& like, bool own_coefficients)
      : row_pitch_(like.row_pitch()),
        plane_pitch_(like.plane_pitch()),
        fraction_(values<float>(like, 0)),
        strength_(own_coefficients ? std::make_unique<CellValues<float>>(values<float>(like, 1)) : nullptr),
        momentum_{values<float>(like, 2), values<float>(like, 3), values<float>(like, 4)},
        exchange_{values<T>(like, 5), values<T>(like, 6), values<T>(like, 7)} {}

  PartialSolidArrays arrays() {
    PartialSolidArrays a;
    a.fraction = fraction_.data();
    a.strength = strength_ ? strength_->data() : fraction_.data();
    a.row_pitch = row_pitch_;
    a.plane_pitch = plane_pitch_;
    std::array<const T*, 3> exchange{};
    for (std::size_t i = 0; i < 3; ++i) {
      a.momentum[i] = momentum_[i].data();
      exchange[i] = exchange_[i].data();
    }
    a.exchange = exchange;
    return a;
  }

  void give_to(KernelCall<T>& call) {
    call.fraction = fraction_.data();
    call.strength = strength_ ? strength_->data() : fraction_.data();
    for (std::size_t i = 0; i < 3; ++i) {
      call.solid_momentum[i] = momentum_[i].data();
      call.exchange[i] = exchange_[i].data();
    }
  }

  /// The exchange of one block of rows, of at most `rows`, goes to a few rows of their own that every block
  /// uses again, and so stays in the cache. Indexed as the whole arrays.
  void give_rows_to(KernelCall<T>& call, const RowBlock& block, int rows) {
    constexpr std::ptrdiff_t guard = 64;
    const std::ptrdiff_t stride = row_pitch_ * rows + guard;
    if (rows_.empty()) rows_.assign(static_cast<std::size_t>(3 * stride + 2 * guard), T(0));
    const std::ptrdiff_t first = row_pitch_ * block.begin_y + plane_pitch_ * block.z;
    for (std::ptrdiff_t i = 0; i < 3; ++i) call.exchange[i] = rows_.data() + (guard + stride * i - first);
  }

  static ExchangeArrays exchange_of(const KernelCall<T>& call) {
    return std::array<const T*, 3>{call.exchange[0], call.exchange[1], call.exchange[2]};
  }

  PartialSolidCell cell(std::ptrdiff_t index) const {
    const float strength = strength_ ? strength_->data()[index] : fraction_.data()[index];
    return {fraction_.data()[index], strength,
            Vec3(momentum_[0].data()[index], momentum_[1].data()[index], momentum_[2].data()[index])};
  }

  std::size_t bytes() const {
    return fraction_.bytes() + (strength_ ? strength_->bytes() : 0) + 3 * momentum_[0].bytes() +
           3 * exchange_[0].bytes() + rows_.size() * sizeof(T);
  }

 private:
  template <class V>
  static CellValues<V> values(const Populations<T>& like, std::size_t number) {
    return CellValues<V>(like.cells(), like.row_pitch(), like.plane_pitch(), number);
  }

  std::ptrdiff_t row_pitch_, plane_pitch_;
  CellValues<float> fraction_;
  std::unique_ptr<CellValues<float>> strength_;
  CellValues<float> momentum_[3];
  CellValues<T> exchange_[3];
  std::vector<T> rows_;
};

}  // namespace suffuse::lbm
