#pragma once

#include <memory>

#include "populations.h"
#include "suffuse/lbm/partial_solids.h"

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

  PartialSolidCell cell(std::ptrdiff_t index) const {
    const float strength = strength_ ? strength_->data()[index] : fraction_.data()[index];
    return {fraction_.data()[index], strength,
            Vec3(momentum_[0].data()[index], momentum_[1].data()[index], momentum_[2].data()[index])};
  }

  std::size_t bytes() const {
    return fraction_.bytes() + (strength_ ? strength_->bytes() : 0) + 3 * momentum_[0].bytes() +
           3 * exchange_[0].bytes();
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
};

}  // namespace suffuse::lbm
