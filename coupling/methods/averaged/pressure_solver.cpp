#include "averaged/pressure_solver.h"

namespace suffuse::coupling::averaged {

namespace {
/// Above, the factors of a cube of cells fill more memory than the iteration reads.
constexpr Eigen::Index kFactorised = 4000;
/// Of the residual: volume is conserved to this share of the flow through a cell.
constexpr double kTolerance = 1e-12;
}  // namespace

struct PressureSolver::Solvers {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> direct;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper,
                           Eigen::IncompleteCholesky<double>>
      iterative;
  Eigen::Index analysed = -1;
};

PressureSolver::PressureSolver() : solvers_(std::make_unique<Solvers>()) {}
PressureSolver::~PressureSolver() = default;

void PressureSolver::solve(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& right_side,
                           Eigen::VectorXd& pressure) {
  const bool new_pattern = solvers_->analysed != matrix.rows();
  solvers_->analysed = matrix.rows();
  if (matrix.rows() <= kFactorised) {
    if (new_pattern) solvers_->direct.analyzePattern(matrix);
    solvers_->direct.factorize(matrix);
    pressure = solvers_->direct.solve(right_side);
    return;
  }
  solvers_->iterative.setTolerance(kTolerance);
  solvers_->iterative.compute(matrix);
  pressure = solvers_->iterative.solveWithGuess(right_side, pressure);
}

}  // namespace suffuse::coupling::averaged
