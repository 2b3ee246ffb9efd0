#pragma once

#include <mpi.h>

#include <algorithm>

#include "suffuse/common/linear_algebra.h"

namespace suffuse::coupling {

/// How far the parts of a grain are from its centre, over how far the centres of its cells are, which mapping
/// takes for them. A grain below two cells is nearer to its centre than those: with their arms its spin would
/// give it many times the moment that its own surface could, and the grain would spin up without bound.
inline double share_of_arms(double radius) {
  return std::min(1., radius);
}

inline Vec3 vector_at(const double* values, int n) {
  return Vec3(values[3 * n], values[3 * n + 1], values[3 * n + 2]);
}

inline void keep(double* values, const Vec3& vector) {
  Eigen::Map<Vec3>{values} = vector;
}

/// Adds the time that it lives to a total.
class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total), start_(MPI_Wtime()) {}
  ~Stopwatch() { total_ += MPI_Wtime() - start_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& total_;
  double start_;
};

}  // namespace suffuse::coupling
