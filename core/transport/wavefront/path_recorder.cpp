#include "transport/wavefront/path_recorder.h"

#include <algorithm>

namespace etendue::transport {

void PathRecorder::start(int path, Vec2 raster, std::optional<Vec2> lens, float time, const Ray& ray) {
  record_ = {.raster = raster, .lens = lens, .time = time, .camera_ray = ray, .vertices = {}, .radiance = Rgb(0)};
  tips_.fill({});
  radiance_.fill(Rgb(0));
  shadows_.clear();
  queued_.clear();
  tips_[static_cast<size_t>(path)].recorded = true;
  root_ = path;
}

RecordedVertex& PathRecorder::add_vertex(int path, int length, const Vec3& wo, const Rgb& throughput) {
  Tip& tip = tips_[static_cast<size_t>(path)];
  RecordedVertex vertex;
  vertex.parent = tip.vertex;
  vertex.scattering = tip.scattering;
  vertex.length = length;
  vertex.origin = tip.vertex < 0 ? record_.camera_ray.origin : vertex_of(path).point.position;
  vertex.wo = wo;
  vertex.throughput = throughput;
  tip = {.recorded = true, .vertex = static_cast<int>(record_.vertices.size()), .scattering = -1};
  return record_.vertices.emplace_back(std::move(vertex));
}

void PathRecorder::arrive(int path, int length, const scene::SurfacePoint& point, const Vec3& wo,
                          const Rgb& throughput) {
  if (records(path)) add_vertex(path, length, wo, throughput).point = point;
}

void PathRecorder::set_lobes(int path, bool diffuse, bool glossy, bool specular) {
  if (!records(path)) return;
  RecordedVertex& vertex = vertex_of(path);
  vertex.diffuse = diffuse;
  vertex.glossy = glossy;
  vertex.specular = specular;
}

void PathRecorder::escape(int path, int length, const Vec3& direction, const Rgb& throughput) {
  if (records(path)) add_vertex(path, length, -direction, throughput).escaped = true;
}

void PathRecorder::add_emission(int path, const RecordedEmission& emission) {
  if (!records(path)) return;
  vertex_of(path).emission = emission;
  add(path, emission.contribution);
}

void PathRecorder::add_medium_emission(int path, const RecordedEmission& emission) {
  if (!records(path)) return;
  vertex_of(path).medium_emission = emission;
  add(path, emission.contribution);
}

void PathRecorder::add_light(int path, const RecordedLight& light, int connection) {
  if (!records(path)) return;
  RecordedVertex& vertex = vertex_of(path);
  vertex.lights.push_back(light);
  RecordedLight& added = vertex.lights.back();
  added.shadow_ray = connection >= 0;
  if (added.shadow_ray) {
    shadows_.push_back({connection, path, tips_[static_cast<size_t>(path)].vertex, vertex.lights.size() - 1});
  } else {
    added.contribution = added.unoccluded;
    add(path, added.contribution);
  }
}

void PathRecorder::resolve(int connection, bool occluded, const Rgb& contribution) {
  const auto shadow = std::ranges::find(shadows_, connection, &Shadow::connection);
  if (shadow == shadows_.end()) return;
  RecordedLight& light = record_.vertices[static_cast<size_t>(shadow->vertex)].lights[shadow->light];
  light.occluded = occluded;
  light.contribution = contribution;
  if (!occluded) add(shadow->path, contribution);
  shadows_.erase(shadow);
}

void PathRecorder::scatter(int path, const LobeSample<Rgb>& sample) {
  if (!records(path)) return;
  auto& samples = vertex_of(path).scattering_samples;
  tips_[static_cast<size_t>(path)].scattering = static_cast<int>(samples.size());
  samples.push_back({.sample = sample});
}

void PathRecorder::play_roulette(int path, const Roulette& roulette) {
  if (records(path)) vertex_of(path).scattering_samples.back().roulette = roulette;
}

void PathRecorder::end(int path, PathEnd reason) {
  if (records(path)) vertex_of(path).scattering_samples.back().end = reason;
}

void PathRecorder::set_throughput(int path, const Rgb& throughput) {
  if (records(path)) vertex_of(path).scattering_samples.back().throughput = throughput;
}

void PathRecorder::queue_branch(int path, int length) {
  if (!records(path)) return;
  const auto at = static_cast<size_t>(length);
  if (queued_.size() <= at) queued_.resize(at + 1);
  queued_[at].push_back(tips_[static_cast<size_t>(path)]);
}

void PathRecorder::resume_branch(int path, int length, int root) {
  if (root != root_) return;
  auto& queue = queued_[static_cast<size_t>(length)];
  tips_[static_cast<size_t>(path)] = queue.back();
  queue.pop_back();
}

void PathRecorder::collect(int paths) {
  Rgb& total = record_.radiance;
  for (int path = 0; path < paths; ++path)
    if (records(path)) total += radiance_[static_cast<size_t>(path)];
  tips_.fill({});
  radiance_.fill(Rgb(0));
}

}  // namespace etendue::transport
