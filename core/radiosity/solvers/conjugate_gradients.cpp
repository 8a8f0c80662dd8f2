// Conjugate gradients of the symmetric system                                             [Hestenes and Stiefel 1952]
//
// Row i of the radiosity equation times A_i / rho_i has the symmetric matrix diag(A / rho) - A F, which is positive
// definite if all reflectances are below 1. With y_i = B_i sqrt(A_i / rho_i) its diagonal is 1. Elements that reflect
// nothing keep their source, whose light is added to the right side.
#include <Eigen/Core>
#include <cmath>

#include "radiosity/solver.h"

namespace etendue::radiosity {
namespace {

using Vector = Eigen::VectorXd;

class SymmetricSystem {
 public:
  explicit SymmetricSystem(const RadiositySystem& system)
      : system_(system), scale_(static_cast<Eigen::Index>(system.size())), right_(scale_.size()) {
    for (Eigen::Index i = 0; i < scale_.size(); ++i) {
      const double rho = system.reflectance[index(i)];
      scale_[i] = rho > 0 ? std::sqrt(rho / area(i)) : 0;
    }
    for (Eigen::Index i = 0; i < scale_.size(); ++i) {
      double received = 0;
      for (const FormFactor& f : system.factors->exchanges(index(i)))
        if (scale_[f.element] == 0) received += static_cast<double>(f.value) * system.source[f.element];
      right_[i] = scale_[i] > 0 ? system.source[index(i)] / scale_[i] + scale_[i] * received : 0;
    }
  }

  const Vector& right() const { return right_; }
  Vector initial() const {
    Vector y(scale_.size());
    for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = scale_[i] > 0 ? system_.source[index(i)] / scale_[i] : 0;
    return y;
  }
  Vector times(const Vector& y) const {
    const Vector scaled = scale_.cwiseProduct(y);
    Vector result(y.size());
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      double sum = 0;
      if (scale_[i] > 0)
        for (const FormFactor& f : system_.factors->exchanges(index(i)))
          sum += static_cast<double>(f.value) * scaled[f.element];
      result[i] = y[i] - scale_[i] * sum;
    }
    return result;
  }
  std::vector<double> radiosity(const Vector& y) const {
    std::vector<double> b(system_.size());
    for (Eigen::Index i = 0; i < y.size(); ++i)
      b[index(i)] = scale_[i] > 0 ? scale_[i] * y[i] : system_.source[index(i)];
    return b;
  }

 private:
  static size_t index(Eigen::Index i) { return static_cast<size_t>(i); }
  double area(Eigen::Index i) const { return system_.factors->areas()[index(i)]; }

  const RadiositySystem& system_;
  Vector scale_;  // sqrt(rho / A), 0 for elements that reflect nothing
  Vector right_;
};

Solution solve_by_conjugate_gradients(const RadiositySystem& system, const SolverSettings& settings) {
  SolverProgress progress(system, settings);
  const SymmetricSystem symmetric(system);
  Vector y = symmetric.initial(), residual = symmetric.right() - symmetric.times(y), direction = residual;
  double squared = residual.squaredNorm();
  while (progress.should_continue(symmetric.radiosity(y)) && squared > 0) {
    const Vector image = symmetric.times(direction);
    const double step = squared / direction.dot(image);
    y += step * direction;
    residual -= step * image;
    const double next = residual.squaredNorm();
    direction = residual + (next / squared) * direction;
    squared = next;
  }
  return progress.finish(symmetric.radiosity(y));
}

}  // namespace

SolverInfo conjugate_gradients_info() {
  return {"Conjugate gradients of the symmetric system. Fewest sweeps, above all for high reflectances",
          solve_by_conjugate_gradients};
}

}  // namespace etendue::radiosity
