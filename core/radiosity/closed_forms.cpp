#include "radiosity/closed_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace etendue::radiosity {
namespace {

constexpr double kPiD = std::numbers::pi;

double square(double x) { return x * x; }

// Nodes and weights of Gauss-Legendre quadrature on [0, 1], from the roots of the Legendre polynomial.
struct Quadrature {
  std::array<double, kMostNodes> node, weight;

  explicit Quadrature(int count) {
    for (int i = 0; i < count; ++i) {
      double x = std::cos(kPiD * (i + 0.75) / (count + 0.5)), slope = 1;
      for (int step = 0; step < 20; ++step) {
        double p = 1, before = 0;
        for (int k = 1; k <= count; ++k) {
          const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
          before = p;
          p = next;
        }
        slope = count * (x * p - before) / (x * x - 1);
        x -= p / slope;
      }
      node[static_cast<size_t>(i)] = 0.5 * (1 + x);
      weight[static_cast<size_t>(i)] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

const Quadrature& quadrature(int count) {
  static const auto all = [] {
    std::vector<Quadrature> list;
    for (int n = 0; n <= kMostNodes; ++n) list.emplace_back(n);
    return list;
  }();
  return all[static_cast<size_t>(std::clamp(count, 1, kMostNodes))];
}

// Maps [0, 1] to itself with vanishing derivatives at both ends.
double smooth(double t) { return t * t * t * (10 + t * (6 * t - 15)); }
double smooth_derivative(double t) { return 30 * square(t * (1 - t)); }

// The integral of ln r from a point along an edge.
double integral_of_log(const DVec3& point, const DVec3& a, const DVec3& direction, double length) {
  const DVec3 d = a - point;
  const double start = glm::dot(d, direction), end = start + length;
  const double h2 = std::max(0.0, glm::dot(d, d) - start * start), h = std::sqrt(h2);
  const auto primitive = [&](double t) {
    const double r2 = h2 + t * t;
    const double log_part = r2 > 0 ? 0.5 * t * std::log(r2) : 0;
    return log_part - t + (h > 0 ? h * std::atan(t / h) : 0);
  };
  return primitive(end) - primitive(start);
}

double edge_pair(const DVec3& a0, const DVec3& a1, const DVec3& b0, const DVec3& b1, int nodes) {
  const double la = glm::distance(a0, a1), lb = glm::distance(b0, b1);
  if (la == 0 || lb == 0) return 0;
  const DVec3 da = (a1 - a0) / la, db = (b1 - b0) / lb;
  const double cosine = glm::dot(da, db);
  if (std::abs(cosine) < 1e-15) return 0;
  const double tiny = 1e-12 * la;
  const bool is_equal = (glm::distance(a0, b0) < tiny && glm::distance(a1, b1) < tiny) ||
                        (glm::distance(a0, b1) < tiny && glm::distance(a1, b0) < tiny);
  if (is_equal) return cosine * la * la * (std::log(la) - 1.5);
  const Quadrature& q = quadrature(nodes);
  double sum = 0;
  for (size_t k = 0; k < static_cast<size_t>(std::clamp(nodes, 1, kMostNodes)); ++k) {
    const DVec3 point = a0 + da * (la * smooth(q.node[k]));
    sum += q.weight[k] * smooth_derivative(q.node[k]) * integral_of_log(point, b0, db, lb);
  }
  return cosine * la * sum;
}

}  // namespace

double parallel_rectangles(double a, double b, double c) {
  const double x = a / c, y = b / c, x2 = x * x, y2 = y * y;
  const double rx = std::sqrt(1 + x2), ry = std::sqrt(1 + y2);
  return 2 / (kPiD * x * y) *
         (0.5 * std::log((1 + x2) * (1 + y2) / (1 + x2 + y2)) + x * ry * std::atan(x / ry) +
          y * rx * std::atan(y / rx) - x * std::atan(x) - y * std::atan(y));
}

double perpendicular_rectangles(double x, double y) {
  const double x2 = x * x, y2 = y * y, r2 = x2 + y2, r = std::sqrt(r2), s = 1 + r2;
  const double logs = std::log((1 + x2) * (1 + y2) / s) + x2 * std::log(x2 * s / ((1 + x2) * r2)) +
                      y2 * std::log(y2 * s / ((1 + y2) * r2));
  return (x * std::atan(1 / x) + y * std::atan(1 / y) - r * std::atan(1 / r) + 0.25 * logs) / (kPiD * x);
}

double coaxial_disks(double r1, double r2, double distance) {
  const double a = r1 / distance, b = r2 / distance, x = 1 + (1 + b * b) / (a * a);
  return 0.5 * (x - std::sqrt(x * x - 4 * square(b / a)));
}

double point_to_disk(double r, double distance, double offset) {
  const double h2 = square(distance), r2 = square(r), a2 = square(offset), sum = h2 + a2 + r2;
  const double root = std::sqrt(square(sum) - 4 * a2 * r2), beyond = sum - 2 * r2;
  // (1 - beyond / root) / 2 without cancellation for small disks.
  return beyond < 0 ? 0.5 * (1 - beyond / root) : 2 * h2 * r2 / (root * (root + beyond));
}

double point_to_rectangle(double u, double v, double w) {
  const double x = u / w, y = v / w, rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * kPiD);
}

Polygon clipped(const Polygon& polygon, const DVec3& point, const DVec3& normal) {
  Polygon kept;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const DVec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double da = glm::dot(a - point, normal), db = glm::dot(b - point, normal);
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

double point_to_polygon(const DVec3& point, const DVec3& normal, const Polygon& polygon) {
  const Polygon front = clipped(polygon, point, normal);
  DVec3 sum(0);
  for (size_t k = 0; k < front.size(); ++k) {
    const DVec3 a = front[k] - point, b = front[(k + 1) % front.size()] - point;
    const DVec3 cross = glm::cross(a, b);
    const double sine = glm::length(cross);
    if (sine > 0) sum += cross * (std::atan2(sine, glm::dot(a, b)) / sine);
  }
  return std::max(0.0, -glm::dot(sum, normal) / (2 * kPiD));
}

double contour_exchange(const Polygon& i, const Polygon& j, int nodes) {
  double sum = 0;
  for (size_t k = 0; k < i.size(); ++k)
    for (size_t l = 0; l < j.size(); ++l)
      sum += edge_pair(i[k], i[(k + 1) % i.size()], j[l], j[(l + 1) % j.size()], nodes);
  return std::max(0.0, sum / (2 * kPiD));
}

}  // namespace etendue::radiosity
