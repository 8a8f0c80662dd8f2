// The importance of places for a camera: how much the light that leaves a place contributes to the image. [Lang, sec. 4.4,
// eq. 4.416-4.421]
//
// Camera paths carry importance as light paths carry flux. If every surface point x emitted the radiance L_e(x), the mean
// radiance of the image would be
//
//   I  =  integral of  w(x) L_e(x) dA(x)
//
// for emission that does not depend on the direction. `w`, in 1/m^2, is the density of the throughputs of the vertices of
// camera paths.
#pragma once
#include <unordered_map>
#include <vector>

#include "integrator/integrator.h"

namespace etendue::integrator {

// The vertex of a camera path.
struct ImportanceSample {
  Vec3 position, normal;  // on the side of the path
  float value;            // luminance of the throughput
  uint32_t node;          // of the scene
};

// Adds the surface vertices of one path per pixel of a block. Paths have at most `max_depth` edges; 0: no limit. False if
// it was cancelled.
bool add_importance(const RenderContext& context, const PixelBlock& block, int max_depth,
                    const TaskContext& task_context, std::vector<ImportanceSample>& samples);

// The density of samples on surfaces, by a kernel of constant radius.
class ImportanceMap {
 public:
  // Each sample counts with value / paths.
  ImportanceMap(std::vector<ImportanceSample> samples, double paths, float radius);

  // w near a point with this normal, in 1/m^2: samples on the same side of surfaces of a similar orientation.
  float density(const Vec3& position, const Vec3& normal) const;

 private:
  using Cell = uint64_t;
  Cell cell_at(const Vec3& position, const Vec3& offset) const;

  std::vector<ImportanceSample> samples_;  // ordered by cell
  std::unordered_map<Cell, std::pair<uint32_t, uint32_t>> ranges_;
  double scale_;
  float radius_;
};

}  // namespace etendue::integrator
