#include "integrator/audit/importance.h"

#include <algorithm>
#include <cmath>

#include "integrator/shared/camera_paths.h"
#include "transport/wavefront/path_estimators.h"
#include "transport/wavefront/subsurface_scattering.h"

namespace etendue::integrator {
namespace {

using Model = transport::ScatteringMedia<false>;

constexpr int kRouletteStart = 4;
// Surfaces whose normals enclose a smaller angle than this cosine have a common density.
constexpr float kSimilarNormals = 0.7f;

// A key of 21 bits per axis.
uint64_t key_of(const Vec3& cell) {
  const auto part = [](float v) { return static_cast<uint64_t>(static_cast<int64_t>(v)) & 0x1fffffU; };
  return part(cell.x) << 42 | part(cell.y) << 21 | part(cell.z);
}

}  // namespace

bool add_importance(const RenderContext& context, const PixelBlock& block, int max_depth,
                    const TaskContext& task_context, std::vector<ImportanceSample>& samples) {
  using namespace transport;
  PathWavefront<Model>& paths = thread_wavefront<Model>();
  const PixelOrder order(block);
  launch_camera_paths(context, block, order, task_context, paths);
  paths.stratify_channels();
  while (paths.trace())
    while (paths.next_hits()) {
      for (int i = 0; i < paths.hit_count(); ++i) {
        const scene::SurfacePoint& point = paths.point(i);
        const float value = luminance(paths.state_at(i).throughput);
        if (point.in_volume || !(value > 0) || !std::isfinite(value)) continue;
        samples.push_back({point.position, point.front ? point.ng : -point.ng, value, point.instance->node});
      }
      if (max_depth > 0 && paths.length() >= max_depth) continue;
      scatter_below_surface(paths);
      sample_bsdf(paths, kRouletteStart);
    }
  return !paths.cancelled();
}

ImportanceMap::ImportanceMap(std::vector<ImportanceSample> samples, double paths, float radius)
    : samples_(std::move(samples)), scale_(1 / (paths * kPi * double{radius} * double{radius})), radius_(radius) {
  const auto cell = [&](const ImportanceSample& s) { return cell_at(s.position, Vec3(0)); };
  std::ranges::sort(samples_, {}, cell);
  for (uint32_t i = 0; i < samples_.size(); ++i) {
    auto& range = ranges_.try_emplace(cell(samples_[i]), i, i).first->second;
    range.second = i + 1;
  }
}

ImportanceMap::Cell ImportanceMap::cell_at(const Vec3& position, const Vec3& offset) const {
  return key_of(glm::floor(position / radius_) + offset);
}

float ImportanceMap::density(const Vec3& position, const Vec3& normal) const {
  double sum = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const auto range =
            ranges_.find(cell_at(position, Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z))));
        if (range == ranges_.end()) continue;
        for (uint32_t i = range->second.first; i < range->second.second; ++i) {
          const ImportanceSample& s = samples_[i];
          if (glm::dot(s.normal, normal) < kSimilarNormals) continue;
          const Vec3 d = s.position - position;
          if (length_squared(d) <= radius_ * radius_) sum += double{s.value};
        }
      }
  return static_cast<float>(sum * scale_);
}

}  // namespace etendue::integrator
