// The operators of light transport as matrices: four formulations of a measurement, norms, Neumann series, relighting
// [Lang, sec. 5.2-5.5]
//
// The surfaces of a scene are divided into patches of constant radiance. The form factors between their sides are the
// propagation operator G, the reflectances the scattering operator K. The sensor is the side of one patch, which measures
// incident radiance; the same number follows from
//
//   <W_eo, L_i>   incident radiance        L_i = (I - G K)^-1 G L_eo
//   <W_o, L_ei>   exitant importance       W_o = (I - K* G*)^-1 W_eo
//   <W_ei, L_o>   exitant radiance         L_o = (I - K G)^-1 L_eo
//   <W_i, L_eo>   incident importance      W_i = (I - G* K*)^-1 G* W_eo
//
// The terms of the Neumann series fall by the spectral radius of K G in the end, and by at most its norm in each step. The
// solution operator (I - K G)^-1 relights the scene: its product with another emission is the new solution. Without the
// first term it is the global reflectance distribution function, which is reciprocal.
//
// Charts show the operators K, G and K G, the radiance that the camera sees, the incident importance of the camera, i.e. how
// much the light at a place contributes to its image, the first terms of the Neumann series, and the eigenvectors of K G of
// the largest eigenvalues: the first is the distribution of light after many reflections. For one element, pictures show
// where its light goes (a column of the global reflectance) and where its light comes from (a row, the adjoint view). Rows
// and columns of matrices are the sides of patches in the order of the scene.
//
// Any scene with few triangles can be given, also as a file. Surfaces are taken as diffuse, with the green component of their
// colours. If no surface emits, the source is the light that surfaces reflect from point lights and the environment.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/operator_model.h"

namespace etendue::experiments {
namespace {

using equations::TransportMatrices;
using equations::Vector;

double largest_of(const Vector& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

double relative_difference(const Vector& a, const Vector& b) {
  double most = 0;
  for (size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most / std::max(largest_of(b), 1e-300);
}

Vector product(const equations::Rows& matrix, const Vector& v) {
  Vector result(matrix.size(), 0.0);
  for (size_t i = 0; i < matrix.size(); ++i)
    for (size_t j = 0; j < v.size(); ++j) result[i] += matrix[i][j] * v[j];
  return result;
}

metrics::MatrixChart matrix(const char* title, equations::Rows rows) {
  return {
      .title = title, .x_label = "element of the source", .y_label = "element of the result", .rows = std::move(rows)};
}

equations::Rows diagonal(const Vector& values) {
  equations::Rows rows(values.size(), Vector(values.size(), 0.0));
  for (size_t i = 0; i < values.size(); ++i) rows[i][i] = values[i];
  return rows;
}

struct TransportOperators {
  static constexpr ExperimentDescription kDescription{
      .name = "transport-operators",
      .label = "Transport operators",
      .summary = "Propagation and scattering as matrices, four formulations of a measurement, importance, relighting",
      .source = "[Lang, eq. 5.40-5.61, 5.122-5.150]"};

  Text scene{"scene",
             "Scene",
             "cornell",
             "The scene that is divided into patches: furnace, a built-in scene, or a .gltf or .glb file",
             check_operator_scene,
             {{"cornell", "Cornell box"}, {"furnace", "Closed cube of albedo 0.75"}}};
  Number<int> patches{"patches", "Patches", 200, {20, 600}, "Approximate number of patches. Time grows with its cube"};
  Number<int> terms{"terms", "Terms", 40, {4, 200}, "Number of terms of the Neumann series"};
  Number<int> eigenvectors{"eigenvectors", "Eigenvectors", 3, {1, 12}, "Number of eigenvectors that are shown"};
  Number<int> pictures{"pictures", "Pictures of terms", 3, {0, 12}, "Number of terms of the series that are shown"};
  Number<int> element{"element",
                      "Element",
                      -1,
                      {-1, 4000},
                      "Element whose light is shown, from both ends. -1: the one in the centre of the image"};

  auto parameters() { return std::tie(scene, patches, terms, eigenvectors, pictures, element); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const auto given = operator_scene(scene);
    if (!given) return given.error();
    auto made = OperatorModel::make(*given, patches);
    if (!made) return made.error();
    OperatorModel& model = *made;
    if (auto ok = model.build(context); !ok) return ok.error();
    const TransportMatrices& t = model.matrices();
    const auto radiance = equations::exitant_radiance(t, model.emitted());
    if (!radiance) return radiance.error();
    ExperimentResult result;
    if (model.has_external_lights())
      result.notes.push_back(
          "No surface emits light: the source is the light that surfaces reflect from other lights.");
    result.table.columns = {"quantity", "value"};
    add_row(result, "elements", static_cast<double>(t.size()));
    if (auto ok = add_measurements(model, result); !ok) return ok.error();
    add_energy(model, *radiance, result);
    add_series(model, *radiance, result);
    if (auto ok = add_relighting(model, result); !ok) return ok.error();
    if (auto ok = add_pictures(model, *radiance, result); !ok) return ok.error();
    add_eigenvectors(model, result);
    if (scene.value == kFurnaceScene)
      result.checks.push_back({"radiance of the furnace", largest_of(*radiance), 1 / (1 - kFurnaceAlbedo), 1e-4});
    return result;
  }

 private:
  static void add_row(ExperimentResult& result, const char* name, double value) {
    result.table.rows.push_back({std::string(name), value});
  }

  // The element of the centre of the image, or the selected one.
  size_t shown_element(const OperatorModel& model) const {
    const int centre = model.visible_elements()[kViewSize * kViewSize / 2 + kViewSize / 2];
    const auto selected = static_cast<size_t>(std::max(element >= 0 ? int{element} : centre, 0));
    return std::min(selected, model.matrices().size() - 1);
  }

  Result<void> add_measurements(const OperatorModel& model, ExperimentResult& result) const {
    const TransportMatrices& t = model.matrices();
    Vector detector(t.size(), 0.0);
    const size_t sensor = shown_element(model);
    detector[sensor] = 1 / (std::numbers::pi * t.area[sensor]);
    const auto m = equations::measurements(t, model.emitted(), detector);
    if (!m) return m.error();
    const double reference = m->exitant_radiance;
    add_row(result, "measurement <W_eo, L_i>", m->incident_radiance);
    add_row(result, "measurement <W_o, L_ei>", m->exitant_importance);
    add_row(result, "measurement <W_ei, L_o>", m->exitant_radiance);
    add_row(result, "measurement <W_i, L_eo>", m->incident_importance);
    for (const auto& [name, value] : {std::pair("<W_eo, L_i> relative to <W_ei, L_o>", m->incident_radiance),
                                      std::pair("<W_o, L_ei> relative to <W_ei, L_o>", m->exitant_importance),
                                      std::pair("<W_i, L_eo> relative to <W_ei, L_o>", m->incident_importance)})
      result.checks.push_back({name, value / reference, 1, 1e-10});
    return {};
  }

  static void add_energy(const OperatorModel& model, const Vector& radiance, ExperimentResult& result) {
    const auto balance = equations::energy_balance(model.matrices(), model.emitted(), radiance);
    add_row(result, "emitted power, W", balance.emitted);
    add_row(result, "absorbed power, W", balance.absorbed);
    add_row(result, "escaped power, W", balance.escaped);
    result.checks.push_back(
        {"(absorbed + escaped) / emitted", (balance.absorbed + balance.escaped) / balance.emitted, 1, 1e-10});
  }

  // Largest values of the terms and of the rest of the series, and the bound by the norm.
  void add_series(const OperatorModel& model, const Vector& radiance, ExperimentResult& result) const {
    const auto norms = equations::transport_norms(model.matrices());
    add_row(result, "norm of K G in L^infinity", norms.supremum);
    add_row(result, "norm of K G in L^1", norms.integral);
    add_row(result, "spectral radius of K G", norms.spectral_radius);
    const auto series = equations::neumann_terms(model.matrices(), model.emitted(), terms);
    metrics::FunctionCurve term{.name = "largest value of term n", .points = {}},
        rest{.name = "largest value of the rest after term n", .points = {}},
        bound{.name = "bound |K G|^n |L_e|", .style = metrics::CurveStyle::dashed, .points = {}};
    Vector sum(radiance.size(), 0.0);
    for (size_t n = 0; n < series.size(); ++n) {
      double missing = 0;
      for (size_t i = 0; i < sum.size(); ++i) {
        sum[i] += series[n][i];
        missing = std::max(missing, std::abs(radiance[i] - sum[i]));
      }
      const auto x = static_cast<double>(n);
      term.points.push_back({x, largest_of(series[n])});
      rest.points.push_back({x, missing});
      bound.points.push_back({x, std::pow(norms.supremum, x) * largest_of(series[0])});
    }
    const double ratio = largest_of(series.back()) / largest_of(series[series.size() - 2]);
    result.checks.push_back({"ratio of the last two terms", ratio, norms.spectral_radius, 0.01});
    result.charts.push_back(metrics::FunctionChart{.title = "Neumann series",
                                                   .x_label = "n",
                                                   .y_label = "radiance",
                                                   .curves = {term, rest, bound},
                                                   .logarithmic_y = true});
    for (size_t n = 1; n < std::min(series.size(), static_cast<size_t>(pictures) + 1); ++n)
      result.charts.push_back(model.picture("Term " + std::to_string(n) + " of the Neumann series", series[n]));
  }

  // Light from every other element instead of the scene's emitters.
  Result<void> add_relighting(const OperatorModel& model, ExperimentResult& result) const {
    const TransportMatrices& t = model.matrices();
    auto solution = equations::solution_operator(t);
    const auto reflected = equations::global_reflectance(t);
    if (!solution) return solution.error();
    if (!reflected) return reflected.error();
    Vector other(t.size(), 0.0);
    for (size_t i = 0; i < t.size(); i += 2) other[i] = 1;
    const auto solved = equations::exitant_radiance(t, other);
    if (!solved) return solved.error();
    result.checks.push_back(
        {"relighting against a new solution", relative_difference(product(*solution, other), *solved), 0, 1e-10});
    double asymmetry = 0, most = 0;
    for (size_t i = 0; i < t.size(); ++i)
      for (size_t j = 0; j < t.size(); ++j) {
        most = std::max(most, t.area[i] * (*reflected)[i][j]);
        asymmetry = std::max(asymmetry, std::abs(t.area[i] * (*reflected)[i][j] - t.area[j] * (*reflected)[j][i]));
      }
    result.checks.push_back({"asymmetry of the global reflectance", asymmetry / most, 0, 1e-10});
    result.charts.push_back(matrix("Propagation operator G", t.propagation));
    result.charts.push_back(matrix("Scattering operator K", diagonal(t.reflectance)));
    result.charts.push_back(matrix("Transport operator K G", equations::transport_operator(t)));
    result.charts.push_back(matrix("Global reflectance K (I - G K)^-1", *reflected));
    // Light that arrives at the element, and its adjoint: where the reflected light of the element comes from.
    const size_t shown = shown_element(model);
    Vector answers(t.size()), sources(t.size());
    for (size_t i = 0; i < t.size(); ++i) {
      answers[i] = (*reflected)[i][shown];
      sources[i] = (*reflected)[shown][i];
    }
    const std::string number = std::to_string(shown);
    result.charts.push_back(model.picture("Light that reaches places by way of element " + number, answers));
    result.charts.push_back(model.picture("Places whose incident light element " + number + " reflects", sources));
    return {};
  }

  // The eigenvalues are real, and T v = lambda v.
  void add_eigenvectors(const OperatorModel& model, ExperimentResult& result) const {
    const auto pairs = equations::leading_eigenpairs(model.matrices(), eigenvectors);
    for (size_t k = 0; k < pairs.size(); ++k) {
      const std::string name = "eigenvalue " + std::to_string(k + 1);
      result.table.rows.push_back({name, pairs[k].value});
      Vector scaled = pairs[k].vector;
      for (double& v : scaled) v *= pairs[k].value;
      result.checks.push_back(
          {"residual of " + name,
           relative_difference(equations::neumann_terms(model.matrices(), pairs[k].vector, 2)[1], scaled), 0, 1e-8});
      result.charts.push_back(model.picture("Eigenvector " + std::to_string(k + 1), pairs[k].vector));
    }
  }

  static Result<void> add_pictures(const OperatorModel& model, const Vector& radiance, ExperimentResult& result) {
    const TransportMatrices& t = model.matrices();
    const Vector source = model.camera_importance();
    const auto importance = equations::incident_importance(t, source);
    if (!importance) return importance.error();
    const double by_radiance = equations::inner_product(t, source, radiance);
    const double by_importance = equations::inner_product(t, *importance, model.emitted());
    add_row(result, "mean radiance of the image", by_radiance);
    result.checks.push_back(
        {"mean of the image by importance over that by radiance", by_importance / by_radiance, 1, 1e-10});
    Vector reflected = radiance;
    for (size_t i = 0; i < reflected.size(); ++i) reflected[i] -= model.emitted()[i];
    result.charts.push_back(model.picture("Reflected radiance", reflected));
    result.charts.push_back(model.picture("Incident importance of the camera", *importance));
    return {};
  }
};

}  // namespace

Experiment transport_operators_experiment() { return make_experiment<TransportOperators>(); }

}  // namespace etendue::experiments
