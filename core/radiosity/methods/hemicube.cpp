// The hemicube                                                              [Cohen and Greenberg 1985; Lang, sec. 10.1.4]
//
// A ray from the centroid of the element through every cell of a hemicube finds the element that the cell shows; its
// factor is the sum of the factors of its cells. Deterministic. Small or distant elements between the rays are missed,
// and one point stands for the whole element, so that factors of close elements are wrong.
#include "radiosity/hemicube.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "base/frame.h"
#include "radiosity/form_factors.h"
#include "radiosity/patch_rays.h"

namespace etendue::radiosity {

std::vector<HemicubeCell> hemicube_cells(int resolution) {
  std::vector<HemicubeCell> cells;
  const double width = 2.0 / resolution, area = width * width;
  const auto centre = [&](int i) { return -1 + (i + 0.5) * width; };
  const auto add = [&](double x, double y, double z, double projected) {
    const double r2 = x * x + y * y + z * z;
    const glm::dvec3 direction = glm::dvec3(x, y, z) / std::sqrt(r2);
    cells.push_back({Vec3(direction), area * projected / (static_cast<double>(kPi) * r2 * r2)});
  };
  for (int i = 0; i < resolution; ++i)
    for (int j = 0; j < resolution; ++j) add(centre(i), centre(j), 1, 1);
  for (int i = 0; i < resolution; ++i)
    for (int j = resolution / 2; j < resolution; ++j)
      for (const double side : {-1.0, 1.0}) {
        add(side, centre(i), centre(j), centre(j));
        add(centre(i), side, centre(j), centre(j));
      }
  return cells;
}

namespace {

// An even resolution with about this many cells.
int resolution_for(uint32_t rays) { return std::max(2, static_cast<int>(std::sqrt(rays / 3.0) / 2 + 0.5) * 2); }

// The cells with factors that sum to 1.
const std::vector<HemicubeCell>& normalized_cells(int resolution) {
  static std::mutex mutex;
  static std::map<int, std::vector<HemicubeCell>> all;
  const std::lock_guard lock(mutex);
  auto& cells = all[resolution];
  if (!cells.empty()) return cells;
  cells = hemicube_cells(resolution);
  double sum = 0;
  for (const HemicubeCell& cell : cells) sum += cell.factor;
  for (HemicubeCell& cell : cells) cell.factor /= sum;
  return cells;
}

uint64_t add_row_by_hemicube(const RowRequest& request) {
  const PatchMesh& mesh = request.mesh;
  const Patch& patch = mesh.patch_of(request.element);
  const Frame frame(mesh.normal_of(request.element), patch.p1 - patch.p0, 1);
  const Vec3 origin = off_surface(mesh, request.element, patch.point(Vec2(1.0f / 3)));
  HitRays rays(request.scene, mesh, element_seed(request.seed, request.element));
  const auto count = [&](uint32_t element, float factor) {
    if (element != request.element) request.row.add(element, static_cast<double>(factor));
  };
  for (const HemicubeCell& cell : normalized_cells(resolution_for(request.samples)))
    rays.add(origin, frame.to_world(cell.direction), static_cast<float>(cell.factor), count);
  rays.trace(count);
  return rays.traced();
}

}  // namespace

FormFactorMethodInfo hemicube_method() {
  return {.doc =
              "Rays from the centroid through the cells of a hemicube. Deterministic; misses what lies between the "
              "rays, and is wrong for close patches",
          .samples_pairs = false,
          .add_row = add_row_by_hemicube};
}

}  // namespace etendue::radiosity
