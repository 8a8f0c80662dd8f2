// A partition of the sphere into cells that are small where given directions are dense, and integrals over the cells.
//
// Each hemisphere is mapped to a square by the equal-area concentric map [Shirley and Chiu 1997]. A square is quartered
// where more directions fall than a cell may hold. Around a narrow lobe the cells have the size of the lobe and grow
// with the distance from it. A few Gauss points per cell are therefore enough to integrate a density as narrow as the
// distribution of the directions.
#pragma once
#include <cmath>
#include <span>
#include <vector>

#include "base/vec.h"

namespace etendue::test {

class SpherePartition {
 public:
  SpherePartition(std::span<const Vec3> directions, size_t most_in_a_cell);

  size_t size() const { return leaves_.size(); }
  size_t cell_of(const Vec3& w) const;

  // The integral of f(direction) over a cell with respect to solid angle. Gauss quadrature in recursively quartered
  // cells until `enough` accepts the difference between a value and a finer one, but at least `levels` levels deep.
  template <class F, class Enough>
  double integrate(size_t cell, F&& f, Enough&& enough, int levels = 0) const {
    const Box& box = boxes_[leaves_[cell]];
    return refined(f, box, gauss(f, box), enough, kDeepest - levels, kDeepest);
  }
  // The integral over the whole sphere, each cell to about this error. Cells wider than `widest` (the square has width
  // 2) are refined at least to that width, which finds narrow ridges where few directions are.
  template <class F>
  double integrate(F&& f, double error, double widest) const {
    const auto enough = [&](double coarse, double fine) { return std::abs(fine - coarse) < error; };
    double sum = 0;
    for (size_t k = 0; k < size(); ++k) {
      int levels = 0;
      for (double width = boxes_[leaves_[k]].width; width > widest && levels < kDeepest; width /= 2) ++levels;
      sum += integrate(k, f, enough, levels);
    }
    return sum;
  }

 private:
  struct Box {
    double x = -1, y = -1, width = 2;
    bool upper = true;
    size_t children = 0;  // index of the first of four; 0 if there are none
    size_t leaf = 0;
  };
  static constexpr int kDeepest = 8;  // levels of quarters within a cell
  struct Point {
    double x, y;
    bool upper;
  };
  static Point to_square(const Vec3& w);
  static Vec3 to_sphere(double x, double y, bool upper);
  static size_t quarter(const Box& box, const Point& p) {
    return (p.x >= box.x + box.width / 2 ? 1U : 0U) + (p.y >= box.y + box.width / 2 ? 2U : 0U);
  }
  static Box quarter_of(const Box& box, size_t k) {
    const double half = box.width / 2;
    return {box.x + (k & 1 ? half : 0), box.y + (k & 2 ? half : 0), half, box.upper, 0, 0};
  }
  void split(size_t box, std::vector<Point> points, size_t most, int depth);

  template <class F>
  static double gauss(F&& f, const Box& box) {
    static constexpr double kNode = 0.38729833462074168852;  // sqrt(3/5) / 2
    static constexpr double kNodes[3] = {0.5 - kNode, 0.5, 0.5 + kNode}, kWeights[3] = {5 / 18.0, 8 / 18.0, 5 / 18.0};
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sum +=
            kWeights[i] * kWeights[j] *
            static_cast<double>(f(to_sphere(box.x + kNodes[i] * box.width, box.y + kNodes[j] * box.width, box.upper)));
    return sum * box.width * box.width * 1.57079632679489661923;  // area of the sphere per unit square: 2 pi / 4
  }
  template <class F, class Enough>
  static double refined(F&& f, const Box& box, double coarse, Enough&& enough, int asked_from, int depth) {
    double parts[4], sum = 0;
    for (size_t k = 0; k < 4; ++k) sum += parts[k] = gauss(f, quarter_of(box, k));
    if (depth == 0 || (depth <= asked_from && enough(coarse, sum))) return sum;
    double fine = 0;
    for (size_t k = 0; k < 4; ++k) fine += refined(f, quarter_of(box, k), parts[k], enough, asked_from, depth - 1);
    return fine;
  }

  std::vector<Box> boxes_;
  std::vector<size_t> leaves_;
};

}  // namespace etendue::test
