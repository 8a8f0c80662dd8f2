// Finite elements for the radiosity equation: the error over the size of the elements [Lang, sec. 10.1.6, 10.1.7]
//
// Two parallel plates of width 1 and infinite length face each other at a distance h. Both have the reflectance rho and
// emit the same light, so their radiosities are equal and satisfy an equation in one dimension:
//
//   B(x) = S(x) + rho integral from 0 to 1 of  h^2 / (2 (h^2 + (x - y)^2)^(3/2))  B(y) dy
//
// It is solved with elements of equal width:
//
//   collocation, constant   the equation holds in the middle of every element: radiosity with points as receivers
//   Galerkin, constant      the residual is orthogonal to the basis: radiosity with exact form factors
//   reconstruction          the values of constant elements, distributed to the ends of the elements and interpolated
//                           linearly (Gouraud shading)
//   collocation, linear     continuous and linear in every element; the equation holds at the ends of the elements
//   Galerkin, linear        the same basis; the residual is orthogonal to it
//
// For smooth light the errors in the norm of L^2 fall with the width of an element: order 1 for constant, order 2 for
// linear elements. Reconstruction gains an order inside the plate, but not in the elements at the ends, where the mean
// of the neighbours is missing: order 3/2. A shadow edge inside an element, in the middle third of the plate here, reduces
// all orders to 1/2, whatever the basis; only a mesh with an element boundary at the edge restores them.
#include <algorithm>
#include <cmath>

#include "equations/fredholm.h"
#include "experiments/error_curves.h"

namespace etendue::experiments {

enum class PlateLight { smooth, shadow_edge };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::PlateLight> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"smooth", "Smooth"}, {"shadow-edge", "Shadow edge at a third"}}};
};

namespace etendue::experiments {
namespace {

using equations::Approximation;
using equations::ElementBasis;
using equations::FredholmEquation;

constexpr double kEdge = 1.0 / 3;  // never at the end of an element if their number is a power of two
constexpr int kReferencePoints = 128;

// The form factor from a point of a plate to the part of the other one from 0 to y.
double factor_to_part(double x, double y, double h) {
  const auto primitive = [&](double d) { return 0.5 * d / std::hypot(h, d); };
  return primitive(y - x) - primitive(-x);
}

struct ElementMethod {
  const char* name;
  Result<Approximation> (*solve)(const FredholmEquation&, int n);
  double smooth_order;  // of the error in the norm of L^2
};

// The linear interpolation of the means of neighbouring elements at their common ends.
Approximation reconstructed(const FredholmEquation& e, const Approximation& constant, int n) {
  const auto middle = [=, a = e.a, width = e.width()](int element) {
    return constant(a + width * (std::clamp(element, 0, n - 1) + 0.5) / n);
  };
  return [=, a = e.a, width = e.width()](double x) {
    const double scaled = std::clamp((x - a) / width, 0.0, 1.0) * n;
    const int element = std::min(static_cast<int>(scaled), n - 1);
    const double left = 0.5 * (middle(element - 1) + middle(element)),
                 right = 0.5 * (middle(element) + middle(element + 1)), t = scaled - element;
    return left * (1 - t) + right * t;
  };
}

const ElementMethod kElementMethods[] = {
    {"collocation, constant", [](const auto& e, int n) { return equations::solve_collocation(e, n); }, 1},
    {"Galerkin, constant", [](const auto& e, int n) { return equations::solve_galerkin(e, ElementBasis::boxes, n); },
     1},
    {"reconstruction of constant elements",
     [](const auto& e, int n) -> Result<Approximation> {
       const auto constant = equations::solve_galerkin(e, ElementBasis::boxes, n);
       if (!constant) return constant.error();
       return reconstructed(e, *constant, n);
     },
     1.5},
    {"collocation, linear", [](const auto& e, int n) { return equations::solve_collocation(e, n, ElementBasis::hats); },
     2},
    {"Galerkin, linear", [](const auto& e, int n) { return equations::solve_galerkin(e, ElementBasis::hats, n); }, 2}};

struct RadiosityElements {
  static constexpr ExperimentDescription kDescription{
      .name = "radiosity-elements",
      .label = "Finite elements for radiosity",
      .summary = "Errors of constant and linear elements, by collocation and Galerkin's method, over the element size",
      .source = "[Lang, eq. 10.139-10.176]"};

  Number<float> distance{"distance", "Distance", 1, {0.2f, 10}, "Distance of the plates over their width"};
  Number<float> reflectance{"reflectance", "Reflectance", 0.8f, {0, 0.99f}, "Reflectance of both plates"};
  Choice<PlateLight> light{"light", "Light", PlateLight::smooth,
                           "Emitted light: smooth, or constant up to a shadow edge and zero behind it"};
  Number<int> elements{
      "elements", "Elements",        128, {16, 512}, "Largest number of elements of a plate. Higher is slower",
      "",         Scale::logarithmic};
  auto parameters() { return std::tie(distance, reflectance, light, elements); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const auto equation = make_plates();
    if (!equation) return equation.error();
    const auto last = static_cast<int>(std::floor(std::log2(static_cast<double>(elements))));
    const std::vector<double> work = powers_of_two(1, last);
    ExperimentResult result;
    result.table.columns = {"method", "elements", "error", "order"};
    ErrorChart chart{.title = "Error of the radiosity", .work = "elements", .error = "error", .curves = {}};
    for (const ElementMethod& method : kElementMethods) {
      std::vector<double> errors;
      for (const double n : work) {
        if (!context.proceed(0)) return interrupted();
        const auto solution = method.solve(*equation, static_cast<int>(n));
        if (!solution) return solution.error();
        errors.push_back(equations::l2_error(*equation, *solution, 12 * static_cast<int>(n)));
      }
      chart.curves.push_back(error_curve(method.name, work, errors));
      const auto s = slope(chart.curves.back(), work.back() / 8);
      result.table.rows.push_back({std::string(method.name), work.back(), errors.back(), s.known ? -s.value : NAN});
      const bool is_smooth = light == PlateLight::smooth;
      if (s.known)
        result.checks.push_back(
            {std::string(method.name) + ": order", -s.value, is_smooth ? method.smooth_order : 0.5, 0.08});
    }
    add_factors(result);
    result.charts = {std::move(chart), radiosity_chart(*equation)};
    return result;
  }

 private:
  double h() const { return static_cast<double>(distance); }
  double rho() const { return static_cast<double>(reflectance); }

  // The reflected light u = B - S is smooth also behind a shadow edge, and satisfies u = rho K S + rho K u.
  Result<FredholmEquation> make_plates() const {
    const double h2 = h() * h(), r = rho(), d = h();
    FredholmEquation e;
    e.kernel = [=](double x, double y) { return r * 0.5 * h2 / std::pow(h2 + (x - y) * (x - y), 1.5); };
    FredholmEquation reflected = e;
    if (light == PlateLight::shadow_edge) {
      e.source = [](double x) { return x < kEdge ? 1.0 : 0.0; };
      reflected.source = [=](double x) { return r * factor_to_part(x, kEdge, d); };
    } else {
      e.source = [](double x) { return 1 + std::sin(3 * x); };
      const auto rule = equations::gauss_legendre(kReferencePoints);
      reflected.source = [=, kernel = e.kernel, source = e.source](double x) {
        double sum = 0;
        for (size_t i = 0; i < rule.size(); ++i)
          sum += rule.weights[i] * kernel(x, rule.nodes[i]) * source(rule.nodes[i]);
        return sum;
      };
    }
    const auto solution = equations::solve_nystrom(reflected, equations::gauss_legendre(kReferencePoints));
    if (!solution) return solution.error();
    e.solution = [source = e.source, extension = solution->extension](double x) { return source(x) + extension(x); };
    return e;
  }

  // The mean factor from one plate to the other has a closed form.
  void add_factors(ExperimentResult& result) const {
    const auto rule = equations::gauss_rule(8, 16);
    double mean = 0;
    for (size_t i = 0; i < rule.size(); ++i) mean += rule.weights[i] * factor_to_part(rule.nodes[i], 1, h());
    result.checks.push_back({"form factor of the plates", mean, std::sqrt(1 + h() * h()) - h(), 1e-10});
  }

  static metrics::FunctionChart radiosity_chart(const FredholmEquation& e) {
    constexpr int kFew = 6, kPoints = 240;
    std::vector<metrics::FunctionCurve> curves{
        {.name = "solution", .style = metrics::CurveStyle::dashed, .points = {}}};
    const auto add = [&](const std::string& name, const Approximation& f) {
      metrics::FunctionCurve curve{.name = name, .points = {}};
      for (int i = 0; i < kPoints; ++i) {
        const double x = (i + 0.5) / kPoints;
        curve.points.push_back({x, f(x)});
      }
      curves.push_back(std::move(curve));
    };
    for (int i = 0; i < kPoints; ++i)
      curves[0].points.push_back({(i + 0.5) / kPoints, e.solution((i + 0.5) / kPoints)});
    for (const size_t m : {size_t{1}, size_t{2}, size_t{4}})
      if (const auto f = kElementMethods[m].solve(e, kFew))
        add(std::string(kElementMethods[m].name) + ", 6 elements", *f);
    return {.title = "Radiosity of a plate", .x_label = "x", .y_label = "B", .curves = std::move(curves)};
  }
};

}  // namespace

Experiment radiosity_elements_experiment() { return make_experiment<RadiosityElements>(); }

}  // namespace etendue::experiments
