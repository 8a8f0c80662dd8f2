// Records the vertices of a wavefront that a recorder follows.
#pragma once
#include "transport/wavefront/path_recorder.h"

namespace etendue::transport {

// The current hits of a wavefront, with the kinds of lobes of their BSDFs.
template <class M, template <class> class Wavefront>
[[gnu::cold, gnu::noinline]] void record_hits(Wavefront<M>& paths, PathRecorder& recorder) {
  for (int i = 0; i < paths.hit_count(); ++i) {
    const int path = paths.path_at(i);
    if (!recorder.records(path)) continue;
    recorder.arrive(path, paths.length(), paths.point(i), paths.wo(i),
                    paths.color().to_rgb(path, paths.state(path).throughput));
    const auto& bsdf = paths.bsdf(i);
    bool has_delta = false;
    if constexpr (!M::kDiffuse) has_delta = bsdf.deltas(paths.wo(i)).count > 0;
    recorder.set_lobes(path, bsdf.has_component(ScatterType::diffuse), bsdf.has_component(ScatterType::glossy),
                       has_delta);
  }
}

// The paths that left the scene on their last segment.
template <class M, template <class> class Wavefront>
[[gnu::cold, gnu::noinline]] void record_misses(Wavefront<M>& paths, PathRecorder& recorder) {
  for (int i = 0; i < paths.miss_count(); ++i) {
    const int path = paths.path_of_miss(i);
    recorder.escape(path, paths.length(), paths.miss_direction(i),
                    paths.color().to_rgb(path, paths.missed_path(i).throughput));
  }
}

}  // namespace etendue::transport
