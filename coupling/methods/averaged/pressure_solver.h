#pragma once

#include <Eigen/Sparse>
#include <memory>
#include <vector>

namespace suffuse::coupling::averaged {

/// Solves the pressure equation of the averaged flow: symmetric, positive definite, the same pattern in every
/// step. Small systems by a factorisation, larger ones by conjugate gradients from the last pressure.
class PressureSolver {
 public:
  PressureSolver();
  ~PressureSolver();

  /// `pressure`: the start, and the result. Every rank that calls it with the same numbers gets the same
  /// ones.
  void solve(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& right_side,
             Eigen::VectorXd& pressure);

 private:
  struct Solvers;
  std::unique_ptr<Solvers> solvers_;
};

}  // namespace suffuse::coupling::averaged
