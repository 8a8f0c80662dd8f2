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
// Charts show the operators, the radiance that the camera sees, the incident importance of the camera, i.e. how much the
// light at a place contributes to its image, and the eigenvector of K G of the largest eigenvalue: the distribution of light
// after many reflections. Rows and columns of matrices are the sides of patches in the order of the scene.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "camera/camera_ray.h"
#include "equations/transport_matrices.h"
#include "experiments/experiment.h"
#include "radiosity/reflectance.h"
#include "radiosity/scene_solution.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"

namespace etendue::experiments {

enum class OperatorScene { cornell, furnace };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::OperatorScene> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"cornell", "Cornell box"}, {"furnace", "Closed cube of albedo 0.75"}}};
};

namespace etendue::experiments {
namespace {

using equations::TransportMatrices;
using equations::Vector;
using radiosity::PatchMesh;

constexpr uint32_t kRays = 1024;  // per side of a patch
constexpr int kViewSize = 64;     // pixels of the pictures
constexpr double kFurnaceAlbedo = 0.75;

// A scene, and the sides of its patches that see another side: the elements of the matrices.
class OperatorModel {
 public:
  OperatorModel(const scene::Scene& scene, const Camera& camera, int patches)
      : camera_(camera),
        scene_(scene::compile(std::make_shared<const scene::Scene>(scene), camera, nullptr)),
        mesh_(*scene_, {.meshing = radiosity::Meshing::area, .patches = patches}) {}

  // Nothing if `context` ends the run.
  bool build(const RunContext& context, float (*component)(const Rgb&)) {
    radiosity::SolutionPlan plan;
    plan.factors = {radiosity::FormFactorMethod::hemisphere, kRays};
    plan.light_samples = 1;  // direct light is not used
    plan.seed = context.seed;
    radiosity::SceneSolution solution(plan, mesh_.element_count());
    for (int task = 0; task < solution.tasks(); ++task) {
      if (!context.proceed(0.9 * task / solution.tasks())) return false;
      solution.run(*scene_, mesh_, task, nullptr);
    }
    const auto reflectance = radiosity::patch_reflectances(*scene_, mesh_);
    solution.finish(mesh_, reflectance);
    collect(*solution.factors(), reflectance, component);
    return true;
  }

  const TransportMatrices& matrices() const { return matrices_; }
  const Vector& emitted() const { return emitted_; }
  const PatchMesh& mesh() const { return mesh_; }
  uint32_t side(size_t element) const { return sides_[element]; }

  // The element that the camera sees in each pixel of a small picture, row by row from the top; -1 for none.
  std::vector<int> visible_elements() const {
    std::vector<int> elements;
    const CameraRays rays(camera_, kViewSize, kViewSize);
    for (int y = 0; y < kViewSize; ++y)
      for (int x = 0; x < kViewSize; ++x) {
        const Ray ray = rays.ray(Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), Vec2(0.5f));
        const Hit hit = scene_->intersect(ray, 0);
        const uint32_t side = hit ? mesh_.element_at(hit, ray.direction) : radiosity::kNoElement;
        elements.push_back(side == radiosity::kNoElement ? -1 : element_of_[side]);
      }
    return elements;
  }

 private:
  void collect(const radiosity::FormFactors& factors, const std::vector<Rgb>& reflectance,
               float (*component)(const Rgb&)) {
    element_of_.assign(mesh_.element_count(), -1);
    for (uint32_t i = 0; i < mesh_.element_count(); ++i)
      if (!factors.exchanges(i).empty()) {
        element_of_[i] = static_cast<int>(sides_.size());
        sides_.push_back(i);
      }
    const size_t n = sides_.size();
    matrices_.propagation.assign(n, Vector(n, 0.0));
    for (size_t row = 0; row < n; ++row) {
      const double area = factors.areas()[sides_[row]];
      for (const auto& f : factors.exchanges(sides_[row]))
        matrices_.propagation[row][static_cast<size_t>(element_of_[f.element])] = static_cast<double>(f.value) / area;
      matrices_.area.push_back(area);
      matrices_.reflectance.push_back(static_cast<double>(component(reflectance[sides_[row] / 2])));
      emitted_.push_back(static_cast<double>(component(emission_of(sides_[row]))));
    }
  }

  Rgb emission_of(uint32_t side) const {
    const auto& instance = scene_->instances()[mesh_.patch_of(side).instance];
    const Material& material = scene_->materials()[instance.material].description;
    return PatchMesh::is_front(side) || material.double_sided ? material.emission : Rgb(0);
  }

  Camera camera_;
  std::shared_ptr<const scene::CompiledScene> scene_;
  PatchMesh mesh_;
  std::vector<uint32_t> sides_;  // of the elements
  std::vector<int> element_of_;  // by side; -1 for sides that see nothing
  TransportMatrices matrices_;
  Vector emitted_;
};

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

metrics::MatrixChart picture(const char* title, const std::vector<int>& visible, const Vector& values) {
  metrics::MatrixChart chart{.title = title, .x_label = "as the camera sees it", .y_label = {}, .rows = {}};
  for (size_t y = 0; y < kViewSize; ++y) {
    chart.rows.emplace_back();
    for (size_t x = 0; x < kViewSize; ++x) {
      const int element = visible[y * kViewSize + x];
      chart.rows.back().push_back(element < 0 ? NAN : values[static_cast<size_t>(element)]);
    }
  }
  return chart;
}

metrics::MatrixChart matrix(const char* title, equations::Rows rows) {
  return {
      .title = title, .x_label = "element of the source", .y_label = "element of the result", .rows = std::move(rows)};
}

// The share of the image that each element fills, per area and solid angle.
Vector camera_importance(const TransportMatrices& t, const std::vector<int>& visible) {
  Vector importance(t.size(), 0.0);
  for (const int element : visible)
    if (element >= 0)
      importance[static_cast<size_t>(element)] +=
          1 / (static_cast<double>(visible.size()) * std::numbers::pi * t.area[static_cast<size_t>(element)]);
  return importance;
}

struct TransportOperators {
  static constexpr ExperimentDescription kDescription{
      .name = "transport-operators",
      .label = "Transport operators",
      .summary = "Propagation and scattering as matrices, four formulations of a measurement, importance, relighting",
      .source = "[Lang, eq. 5.40-5.61, 5.122-5.150]"};

  Choice<OperatorScene> scene{"scene", "Scene", OperatorScene::cornell, "The scene that is divided into patches"};
  Number<int> patches{"patches", "Patches", 200, {20, 600}, "Approximate number of patches. Time grows with its cube"};
  Number<int> terms{"terms", "Terms", 40, {4, 200}, "Number of terms of the Neumann series"};

  auto parameters() { return std::tie(scene, patches, terms); }

  Result<ExperimentResult> run(const RunContext& context) const {
    OperatorModel model = make_model();
    if (!model.build(context, [](const Rgb& c) { return c.g; })) return interrupted();
    const TransportMatrices& t = model.matrices();
    const auto radiance = equations::exitant_radiance(t, model.emitted());
    if (!radiance) return radiance.error();
    ExperimentResult result;
    result.table.columns = {"quantity", "value"};
    add_row(result, "elements", static_cast<double>(t.size()));
    if (auto ok = add_measurements(model, result); !ok) return ok.error();
    add_energy(model, *radiance, result);
    add_series(model, *radiance, result);
    if (auto ok = add_relighting(model, result); !ok) return ok.error();
    if (auto ok = add_pictures(model, *radiance, result); !ok) return ok.error();
    if (scene.value == OperatorScene::furnace)
      result.checks.push_back({"radiance of the furnace", largest_of(*radiance), 1 / (1 - kFurnaceAlbedo), 1e-4});
    return result;
  }

 private:
  OperatorModel make_model() const {
    if (scene.value == OperatorScene::furnace)
      return {scene::furnace(kFurnaceAlbedo), look_at({0.9f, 0.9f, 0.9f}, {0, 0, 0}, {0, 1, 0}, 1.2f), patches};
    const scene::Scene built = scene::find_builtin("cornell")->make();
    return {built, scene::placed_cameras(built).front(), patches};
  }

  static void add_row(ExperimentResult& result, const char* name, double value) {
    result.table.rows.push_back({std::string(name), value});
  }

  // The sensor is the element that faces the camera's image in its centre.
  static Result<void> add_measurements(const OperatorModel& model, ExperimentResult& result) {
    const TransportMatrices& t = model.matrices();
    const auto visible = model.visible_elements();
    const int centre = visible[kViewSize * kViewSize / 2 + kViewSize / 2];
    Vector detector(t.size(), 0.0);
    const auto sensor = static_cast<size_t>(std::max(centre, 0));
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
  }

  // Light from every other element instead of the scene's emitters.
  static Result<void> add_relighting(const OperatorModel& model, ExperimentResult& result) {
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
    result.charts.push_back(matrix("Global reflectance K (I - G K)^-1", *reflected));
    return {};
  }

  static Result<void> add_pictures(const OperatorModel& model, const Vector& radiance, ExperimentResult& result) {
    const TransportMatrices& t = model.matrices();
    const auto visible = model.visible_elements();
    const Vector source = camera_importance(t, visible);
    const auto importance = equations::incident_importance(t, source);
    if (!importance) return importance.error();
    const double by_radiance = equations::inner_product(t, source, radiance);
    const double by_importance = equations::inner_product(t, *importance, model.emitted());
    add_row(result, "mean radiance of the image", by_radiance);
    result.checks.push_back(
        {"mean of the image by importance over that by radiance", by_importance / by_radiance, 1, 1e-10});
    Vector reflected = radiance;
    for (size_t i = 0; i < reflected.size(); ++i) reflected[i] -= model.emitted()[i];
    result.charts.push_back(picture("Reflected radiance", visible, reflected));
    result.charts.push_back(picture("Incident importance of the camera", visible, *importance));
    result.charts.push_back(
        picture("Eigenvector of the largest eigenvalue", visible, equations::leading_eigenvector(t)));
    return {};
  }
};

}  // namespace

Experiment transport_operators_experiment() { return make_experiment<TransportOperators>(); }

}  // namespace etendue::experiments
