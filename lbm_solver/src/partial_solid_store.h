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
        fraction_(like.cells(), row_pitch_, plane_pitch_),
        strength_(own_coefficients
                      ? std::make_unique<CellValues<float>>(like.cells(), row_pitch_, plane_pitch_)
                      : nullptr),
        momentum_{{like.cells(), row_pitch_, plane_pitch_},
                  {like.cells(), row_pitch_, plane_pitch_},
                  {like.cells(), row_pitch_, plane_pitch_}},
        exchange_{{like.cells(), row_pitch_, plane_pitch_},
                  {like.cells(), row_pitch_, plane_pitch_},
                  {like.cells(), row_pitch_, plane_pitch_}} {}

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
  std::ptrdiff_t row_pitch_, plane_pitch_;
  CellValues<float> fraction_;
  std::unique_ptr<CellValues<float>> strength_;
  CellValues<float> momentum_[3];
  CellValues<T> exchange_[3];
};

}  // namespace suffuse::lbm
