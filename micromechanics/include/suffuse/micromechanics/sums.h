#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "suffuse/common/linear_algebra.h"

namespace suffuse::micromechanics {

/// Nine components of a second-order tensor, row by row, as plain doubles that can be added over ranks.
struct TensorSum {
  std::array<double, 9> values{};

  void add(const Mat3& term) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) values[index(row, column)] += term(row, column);
  }

  Mat3 matrix() const {
    Mat3 result;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) result(row, column) = values[index(row, column)];
    return result;
  }

 private:
  static std::size_t index(int row, int column) { return static_cast<std::size_t>(3 * row + column); }
};

/// A struct of additive sums: nothing but doubles, so that sums of parts of a packing add up to the sum of
/// the whole, member by member (one MPI_Allreduce).
template <class Sums>
concept AdditiveSums = std::is_standard_layout_v<Sums> && std::is_trivially_copyable_v<Sums> && sizeof(Sums) %
                               sizeof(double) ==
                           0 &&
                       alignof(Sums) == alignof(double);

/// The members of `sums` as one row of doubles.
template <AdditiveSums Sums>
std::span<double> as_doubles(Sums& sums) {
  return {reinterpret_cast<double*>(&sums), sizeof(Sums) / sizeof(double)};
}

/// Sums of several parts, such as layers, as one row of doubles.
template <AdditiveSums Sums>
std::span<double> as_doubles(std::vector<Sums>& parts) {
  return {reinterpret_cast<double*>(parts.data()), parts.size() * sizeof(Sums) / sizeof(double)};
}

/// Adds the sums of another part of the packing, as MPI_SUM would.
template <AdditiveSums Sums>
void add_sums(Sums& total, Sums part) {
  const std::span<double> to = as_doubles(total);
  const std::span<double> from = as_doubles(part);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
}

}  // namespace suffuse::micromechanics
