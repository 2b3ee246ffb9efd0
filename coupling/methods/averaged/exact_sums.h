#pragma once

#include <mpi.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace suffuse::coupling::averaged {

/// Sums over grains of all ranks whose last digit does not depend on the order of the grains or on who owns
/// them: whole numbers of a unit that a power of two fixes. With N grains the unit is N 2^-61 of the largest
/// contribution.
class ExactSums {
 public:
  /// `largest`: no contribution of any rank is larger; `grains`: of all ranks.
  ExactSums(std::size_t size, double largest, long grains) : counts_(size, 0) {
    int exponent = 0;
    if (largest > 0 && std::isfinite(largest)) std::frexp(largest, &exponent);
    int grain_bits = 0;
    while ((1L << grain_bits) < grains + 1) ++grain_bits;
    const int shift = 61 - grain_bits - exponent;
    scale_ = std::ldexp(1., shift);
    unit_ = std::ldexp(1., -shift);
  }

  void add(std::size_t at, double value) { counts_[at] += std::llrint(value * scale_); }

  /// Sums over all ranks, times `factor`. Collective.
  void finish(MPI_Comm communicator, double factor, std::vector<double>& result) {
    MPI_Allreduce(MPI_IN_PLACE, counts_.data(), static_cast<int>(counts_.size()), MPI_INT64_T, MPI_SUM,
                  communicator);
    result.resize(counts_.size());
    for (std::size_t n = 0; n < counts_.size(); ++n)
      result[n] = factor * (unit_ * static_cast<double>(counts_[n]));
  }

 private:
  double scale_ = 1, unit_ = 1;
  std::vector<std::int64_t> counts_;
};

}  // namespace suffuse::coupling::averaged
