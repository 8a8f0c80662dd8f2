#include "integrator/radiosity/solution_display.h"

#include <cmath>
#include <optional>

#include "radiosity/reconstruction.h"
#include "radiosity/scene_solution.h"

namespace etendue::integrator {
namespace {

using radiosity::PatchMesh;
using radiosity::PatchVertices;
using radiosity::SceneSolution;

// The root mean square difference between the irradiance of patches and its linear reconstruction at their centroids,
// relative to the mean.
std::optional<double> mesh_error(const PatchMesh& mesh, const PatchVertices& known, const SceneSolution& solution) {
  const std::vector<Rgb>& irradiance = solution.field().total;
  const PatchVertices vertices = known.empty() ? PatchVertices(mesh) : known;
  const std::vector<Rgb> smooth = vertices.at_vertices(mesh, irradiance);
  double squares = 0, mean = 0, area = 0;
  for (uint32_t e = 0; e < irradiance.size(); ++e) {
    const double a = mesh.patch_of(e).area, here = luminance(irradiance[e]);
    const double there = luminance(vertices.interpolate(smooth, {e, Vec2(1.0f / 3)}));
    if (here == 0 && there == 0) continue;
    squares += a * sqr(here - there);
    mean += a * here;
    area += a;
  }
  if (!(mean > 0)) return {};
  return std::sqrt(squares / area) / (mean / area);
}

}  // namespace

std::shared_ptr<const std::vector<StoredPoint>> patch_points(const PatchMesh& mesh, const std::vector<Rgb>& reflectance,
                                                             const SceneSolution& solution, size_t most) {
  auto points = std::make_shared<std::vector<StoredPoint>>();
  const auto& irradiance = solution.field().total;
  for (size_t p = 0; p < mesh.patches().size() && points->size() < most; ++p) {
    const radiosity::Patch& patch = mesh.patches()[p];
    points->push_back(
        {patch.point(Vec2(1.0f / 3)), reflectance[p] * (irradiance[2 * p] + irradiance[2 * p + 1]) * patch.area});
  }
  return points;
}

std::vector<Statistic> solution_statistics(const PatchMesh& mesh, const PatchVertices& vertices,
                                           const SceneSolution& solution) {
  const auto& quality = solution.factors()->quality();
  const auto& field = solution.field();
  std::vector<Statistic> list{
      {"patches", static_cast<double>(mesh.patches().size()), "", "Patches of the mesh; each has two sides"},
      {"dropped-triangles", static_cast<double>(mesh.quality().degenerate), "", "Triangles without area, left out"},
      {"closure", quality.mean_closure, "", "Mean sum of the form factors of a patch side; 1 if no light escapes"},
      {"asymmetry", 100 * quality.asymmetry, "%", "Relative difference of both estimates of a pair's form factor"},
      {"sweeps", static_cast<double>(field.sweeps), "", "Sweeps of the solver"},
      {"solver-error", 100 * field.error_bound, "%",
       "Bound of the solver's error, relative to the largest radiosity; infinite if a patch reflects all light"},
      {"diverged", field.has_diverged ? 1.0 : 0.0, "",
       "1 if the solver diverged; the image has direct light only then"}};
  if (const auto step = mesh_error(mesh, vertices, solution))
    list.push_back(
        {"mesh-error", 100 * *step, "%",
         "Typical difference of irradiance between neighbouring patches, relative to the mean: a scale of the "
         "bias of the mesh"});
  return list;
}

std::shared_ptr<SolutionView> view_of(const PatchMesh& mesh, const std::vector<Rgb>& reflectance,
                                      const SceneSolution& solution) {
  auto view = std::make_shared<SolutionView>();
  const radiosity::FormFactors* factors = solution.factors().get();
  view->has_factors = factors != nullptr;
  view->is_complete = solution.is_ready();
  if (view->is_complete) view->problem = solution.field().problem;
  const auto histories = solution.history();
  for (size_t c = 0; c < histories.size(); ++c) view->history[c] = {histories[c].residuals, histories[c].seconds};
  const auto side = [&](size_t element) {
    SolutionView::Side s;
    if (factors) {
      s.closure = factors->row_quality()[element].closure;
      s.asymmetry = factors->row_quality()[element].asymmetry;
      s.sees_others = !factors->exchanges(element).empty();
    }
    if (solution.is_ready()) {
      s.radiosity = reflectance[element / 2] * solution.field().total[element];
      s.unshot = solution.field().unshot[element];
    }
    return s;
  };
  view->patches.reserve(mesh.patches().size());
  for (size_t p = 0; p < mesh.patches().size(); ++p) {
    const radiosity::Patch& patch = mesh.patches()[p];
    view->patches.push_back({.corners = {patch.p0, patch.p1, patch.p2},
                             .normal = patch.normal,
                             .area = patch.area,
                             .front = side(2 * p),
                             .back = side(2 * p + 1)});
  }
  return view;
}

}  // namespace etendue::integrator
