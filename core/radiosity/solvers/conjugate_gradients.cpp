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
  // Element i of the product with y.
  double product_at(Eigen::Index i, const Vector& y) const {
    double sum = 0;
    if (scale_[i] > 0)
      for (const FormFactor& f : system_.factors->exchanges(index(i)))
        sum += static_cast<double>(f.value) * scale_[f.element] * y[f.element];
    return y[i] - scale_[i] * sum;
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

class ConjugateGradients final : public SolverIteration {
 public:
  explicit ConjugateGradients(const RadiositySystem& system)
      : system_(system), symmetric_(system), y_(symmetric_.initial()), residual_(y_.size()), image_(y_.size()) {
    for (Eigen::Index i = 0; i < y_.size(); ++i) residual_[i] = symmetric_.right()[i] - symmetric_.product_at(i, y_);
    direction_ = residual_;
    squared_ = residual_.squaredNorm();
  }

  bool sweep(const KeepGoing* keep_going) override {
    const auto cost = [&](size_t i) { return 1 + system_.factors->exchanges(i).size(); };
    const auto multiply = [&](size_t i) {
      const auto index = static_cast<Eigen::Index>(i);
      image_[index] = symmetric_.product_at(index, direction_);
    };
    if (!continue_loop(next_, system_.size(), keep_going, cost, multiply)) return false;
    next_ = 0;
    const double step = squared_ / direction_.dot(image_);
    y_ += step * direction_;
    residual_ -= step * image_;
    const double next = residual_.squaredNorm();
    direction_ = residual_ + (next / squared_) * direction_;
    squared_ = next;
    return true;
  }
  std::vector<double> radiosity() const override { return symmetric_.radiosity(y_); }
  bool can_improve() const override { return squared_ > 0; }

 private:
  const RadiositySystem& system_;
  SymmetricSystem symmetric_;
  Vector y_, residual_, direction_, image_;
  double squared_ = 0;  // norm of the residual
  size_t next_ = 0;
};

std::unique_ptr<SolverIteration> begin_conjugate_gradients(const RadiositySystem& system, const SolverSettings&) {
  return std::make_unique<ConjugateGradients>(system);
}

}  // namespace

SolverInfo conjugate_gradients_info() {
  return {"Conjugate gradients of the symmetric system. Fewest sweeps, above all for high reflectances",
          begin_conjugate_gradients, 6 * sizeof(double)};
}

}  // namespace etendue::radiosity
