// LU decomposition of the dense matrix                                             [Lang, sec. 10.1.5, eq. 10.100]
//
// The reference for the iterative solvers. Time grows with n^3 and memory with n^2. Columns are eliminated in blocks, so
// that the decomposition can be stopped; pivots are the largest elements of their columns.
#include <Eigen/Core>

#include "radiosity/solver.h"

namespace etendue::radiosity {
namespace {

constexpr size_t kMostElements = 8192;  // a matrix of 512 MiB
constexpr Eigen::Index kBlock = 32;     // columns that are eliminated at a time

class DirectSolver final : public SolverIteration {
 public:
  explicit DirectSolver(const RadiositySystem& system) : system_(system), radiosity_(system.source) {}

  bool sweep(const KeepGoing* keep_going) override {
    if (matrix_.size() == 0) set_up();
    for (; done_ < matrix_.cols(); done_ += kBlock) {
      if (stops(keep_going)) return false;
      eliminate(std::min(kBlock, matrix_.cols() - done_));
    }
    matrix_.triangularView<Eigen::UnitLower>().solveInPlace(right_);
    matrix_.triangularView<Eigen::Upper>().solveInPlace(right_);
    radiosity_.assign(right_.data(), right_.data() + right_.size());
    is_done_ = true;
    return true;
  }
  std::vector<double> radiosity() const override { return radiosity_; }
  bool can_improve() const override { return !is_done_ && system_.size() > 0; }

 private:
  void set_up() {
    const auto n = static_cast<Eigen::Index>(system_.size());
    matrix_ = Eigen::MatrixXd::Identity(n, n);
    right_ = Eigen::Map<const Eigen::VectorXd>(system_.source.data(), n);
    for (size_t i = 0; i < system_.size(); ++i)
      for (const FormFactor& f : system_.factors->exchanges(i))
        matrix_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(f.element)) -=
            system_.reflectance[i] * static_cast<double>(f.value) / system_.factors->areas()[i];
  }

  // Decomposes `width` columns from done_ on, and subtracts their product from the columns behind them.
  void eliminate(Eigen::Index width) {
    const Eigen::Index below = matrix_.rows() - done_, behind = matrix_.cols() - done_ - width;
    for (Eigen::Index k = done_; k < done_ + width; ++k) {
      Eigen::Index pivot = 0;
      matrix_.col(k).tail(matrix_.rows() - k).cwiseAbs().maxCoeff(&pivot);
      matrix_.row(k).swap(matrix_.row(k + pivot));
      std::swap(right_[k], right_[k + pivot]);
      const Eigen::Index rest = matrix_.rows() - k - 1, columns = done_ + width - k - 1;
      matrix_.col(k).tail(rest) /= matrix_(k, k);
      matrix_.block(k + 1, k + 1, rest, columns).noalias() -=
          matrix_.col(k).tail(rest) * matrix_.row(k).segment(k + 1, columns);
    }
    auto upper = matrix_.block(done_, done_ + width, width, behind);
    matrix_.block(done_, done_, width, width).triangularView<Eigen::UnitLower>().solveInPlace(upper);
    matrix_.block(done_ + width, done_ + width, below - width, behind).noalias() -=
        matrix_.block(done_ + width, done_, below - width, width) * upper;
  }

  const RadiositySystem& system_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
  Eigen::Index done_ = 0;
  bool is_done_ = false;
  std::vector<double> radiosity_;
};

std::unique_ptr<SolverIteration> begin_direct_solver(const RadiositySystem& system, const SolverSettings&) {
  return std::make_unique<DirectSolver>(system);
}

}  // namespace

SolverInfo direct_solver_info() {
  return {
      "LU decomposition: exact up to rounding. Time grows with the third power of the number of elements; at most "
      "4096 patches",
      begin_direct_solver, 2 * sizeof(double), kMostElements, true};
}

}  // namespace etendue::radiosity
