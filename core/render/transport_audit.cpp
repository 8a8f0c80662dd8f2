#include "render/transport_audit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "film/film.h"
#include "integrator/audit/energy.h"
#include "integrator/audit/importance.h"
#include "render/prepared_document.h"
#include "render/thread_pool.h"

namespace etendue::render {
namespace {

using integrator::EnergySums;
using integrator::ObjectFlux;
using integrator::PixelBlock;
using Flux = std::array<double, 3>;

constexpr int kBatches = 32;
constexpr double kStandardErrors = 4;
constexpr double kRounding = 1e-5;        // of the received or emitted flux
constexpr double kKernelFraction = 0.01;  // radius of the density relative to the diagonal of the scene

double luminous(const Flux& flux) { return 0.212671 * flux[0] + 0.715160 * flux[1] + 0.072169 * flux[2]; }

// The mean of a quantity of the batches.
template <class Batches, class Quantity>
Measured measured(const Batches& batches, Quantity&& quantity) {
  const auto n = static_cast<double>(batches.size());
  double sum = 0, squares = 0;
  for (const auto& batch : batches) sum += quantity(batch);
  const double mean = sum / n;
  for (const auto& batch : batches) squares += std::pow(quantity(batch) - mean, 2);
  return {mean, std::sqrt(squares / (n * (n - 1)))};
}

Flux sum_of(const EnergySums& sums, Flux ObjectFlux::*part) {
  Flux total{};
  for (const ObjectFlux& object : sums.objects)
    for (size_t c = 0; c < 3; ++c) total[c] += (object.*part)[c];
  return total;
}

double total_emitted(const EnergySums& s) {
  return luminous(sum_of(s, &ObjectFlux::emitted)) + luminous(s.media.emitted) + luminous(s.environment) +
         luminous(s.point_lights);
}
double total_absorbed(const EnergySums& s) { return luminous(sum_of(s, &ObjectFlux::absorbed)); }

std::string name_of(const scene::CompiledScene& scene, size_t node) {
  const std::string& name = scene.description().nodes[node].name;
  return name.empty() ? "node " + std::to_string(node) : name;
}

ObjectEnergy object_energy(const std::vector<EnergySums>& batches, const std::string& name, size_t node) {
  const auto of = [&](Flux ObjectFlux::*part) {
    return measured(batches, [&](const EnergySums& s) { return luminous(s.objects[node].*part); });
  };
  ObjectEnergy object{.name = name,
                      .node = static_cast<uint32_t>(node),
                      .emitted = of(&ObjectFlux::emitted),
                      .received = of(&ObjectFlux::received),
                      .absorbed = of(&ObjectFlux::absorbed)};
  for (size_t c = 0; c < 3; ++c) {
    const Measured received = measured(batches, [&](const EnergySums&s) { return s.objects[node].received[c]; }),
                   absorbed = measured(batches, [&](const EnergySums&s) { return s.objects[node].absorbed[c]; });
    if (!(received.value > 0)) continue;
    object.largest_albedo = std::max(object.largest_albedo, 1 - absorbed.value / received.value);
    if (absorbed.value < -kStandardErrors * absorbed.standard_error - kRounding * received.value)
      object.creates_energy = true;
  }
  return object;
}

std::string percent(double value) { return std::to_string(std::lround(100 * value)) + " %"; }

void add_warnings(EnergyAudit& audit) {
  for (const ObjectEnergy& object : audit.objects)
    if (object.creates_energy)
      audit.warnings.push_back("'" + object.name + "' creates energy: it scatters " + percent(object.largest_albedo) +
                               " of the light that it receives in one channel; lower its reflectance");
  const double allowed = kStandardErrors * audit.missing.standard_error + kRounding * audit.emitted.value;
  if (audit.missing.value > allowed)
    audit.warnings.push_back(
        percent(audit.missing.value / audit.emitted.value) +
        " of the light is neither absorbed nor does it escape: it stays in the scene for more than " +
        std::to_string(integrator::kMostVertices) + " reflections");
  if (audit.missing.value < -allowed)
    audit.warnings.push_back("more light is absorbed and escapes than is emitted: the scene creates energy");
}

// A document whose light paths are independent of each other.
Document document_with(const Document& document, const char* integrator) {
  Document d = document;
  d.method.integrator = integrator;
  d.method.sampler = "random";
  d.method.paths.clear();
  d.method.color = transport::ColorMode::rgb;
  d.method.adaptive = Adaptive::off;
  return d;
}

}  // namespace

Result<EnergyAudit> audit_energy(const Document& document, std::shared_ptr<const scene::CompiledScene> scene,
                                 uint64_t paths, int threads, const std::function<bool()>& continues) {
  const scene::CompiledScene& compiled = *scene;
  PreparedDocument prepared(document_with(document, "light"), std::move(scene));
  if (!prepared.refusal().empty()) return input_error("light paths: " + prepared.refusal());
  const integrator::RenderContext context = prepared.context();
  const int per_batch = static_cast<int>(std::max<uint64_t>(1, paths / kBatches));
  std::vector<EnergySums> batches(kBatches);
  for (EnergySums& batch : batches) batch.objects.resize(compiled.description().nodes.size());
  const std::function<bool()> keep_going = continues;
  ThreadPool workers(threads);
  workers.run(
      0, kBatches,
      [&](int batch) {
        integrator::add_energy(context, 0, static_cast<uint32_t>(batch) * static_cast<uint32_t>(per_batch), per_batch,
                               {.keep_going = &keep_going}, batches[static_cast<size_t>(batch)]);
      },
      continues);
  if (!continues()) return input_error("the audit was interrupted");

  EnergyAudit audit;
  audit.paths = static_cast<uint64_t>(per_batch) * kBatches;
  audit.emitted = measured(batches, total_emitted);
  if (!(audit.emitted.value > 0)) return input_error("nothing in the scene emits light: add a light or an environment");
  audit.by_media = measured(batches, [](const EnergySums& s) { return luminous(s.media.emitted); });
  audit.by_environment = measured(batches, [](const EnergySums& s) { return luminous(s.environment); });
  audit.by_point_lights = measured(batches, [](const EnergySums& s) { return luminous(s.point_lights); });
  audit.absorbed = measured(batches, total_absorbed);
  audit.absorbed_by_media = measured(batches, [](const EnergySums& s) { return luminous(s.media.absorbed); });
  audit.escaped = measured(batches, [](const EnergySums& s) { return luminous(s.escaped); });
  audit.beyond_range = measured(batches, [](const EnergySums& s) { return luminous(s.beyond_range); });
  audit.missing = measured(batches, [](const EnergySums& s) {
    return total_emitted(s) - total_absorbed(s) - luminous(s.media.absorbed) - luminous(s.escaped) -
           luminous(s.beyond_range);
  });
  for (size_t node = 0; node < compiled.description().nodes.size(); ++node) {
    ObjectEnergy object = object_energy(batches, name_of(compiled, node), node);
    if (object.emitted.value > 0 || object.received.value > 0) audit.objects.push_back(std::move(object));
  }
  add_warnings(audit);
  return audit;
}

namespace {

// The vertices of the camera paths of a document, by batches of samples.
struct ImportancePaths {
  std::vector<integrator::ImportanceSample> vertices;
  std::vector<std::vector<double>> by_object;  // by batch, then by node: mean sum of values per path
};

ImportancePaths trace_importance(PreparedDocument& prepared, const Document& document, size_t nodes, uint32_t samples,
                                 ThreadPool& workers, const std::function<bool()>& continues) {
  const integrator::RenderContext context = prepared.context();
  const int columns = (document.width + PixelBlock::kWidth - 1) / PixelBlock::kWidth,
            rows = (document.height + PixelBlock::kHeight - 1) / PixelBlock::kHeight;
  const double pixels = static_cast<double>(document.width) * document.height;
  const std::function<bool()> keep_going = continues;
  ImportancePaths paths;
  for (uint32_t sample = 0; sample < samples; ++sample) {
    if (sample % film::kHalfBuffers == 0) prepared.prepare_sampler(sample / film::kHalfBuffers);
    std::vector<std::vector<integrator::ImportanceSample>> blocks(static_cast<size_t>(columns * rows));
    workers.run(
        0, columns * rows,
        [&](int number) {
          const auto block = integrator::block_containing(number % columns * PixelBlock::kWidth,
                                                          number / columns * PixelBlock::kHeight, document.width,
                                                          document.height, sample);
          integrator::add_importance(context, block, 0, {.keep_going = &keep_going},
                                     blocks[static_cast<size_t>(number)]);
        },
        continues);
    paths.by_object.emplace_back(nodes, 0.0);
    for (const auto& block : blocks)
      for (const integrator::ImportanceSample& s : block) {
        paths.by_object.back()[s.node] += double{s.value} / pixels;
        paths.vertices.push_back(s);
      }
    if (!continues()) break;
  }
  return paths;
}

// The density at what a camera sees, in the size of the document.
image::Layer density_picture(const integrator::ImportanceMap& map, const scene::CompiledScene& scene,
                             const Document& document, const Camera& view, ThreadPool& workers,
                             const std::function<bool()>& continues) {
  const auto width = static_cast<size_t>(document.width);
  image::Layer layer{"importance", {"V"}, std::vector<float>(width * static_cast<size_t>(document.height))};
  const CameraRays rays(view, document.width, document.height);
  workers.run(
      0, document.height,
      [&](int y) {
        for (int x = 0; x < document.width; ++x) {
          const Ray ray = rays.ray(Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), Vec2(0.5f));
          const Hit hit = scene.intersect(ray, 0);
          if (!hit) continue;
          scene::SurfacePoint point;
          const Vec3 wo = -ray.direction;
          scene.surfaces({&wo, 1}, {&hit, 1}, &point, nullptr);
          layer.pixels[static_cast<size_t>(y) * width + static_cast<size_t>(x)] =
              map.density(point.position, point.front ? point.ng : -point.ng);
        }
      },
      continues);
  return layer;
}

}  // namespace

Result<ImportanceAudit> audit_importance(const Document& document, std::shared_ptr<const scene::CompiledScene> scene,
                                         const Camera& view, uint32_t samples, float radius, int threads,
                                         const std::function<bool()>& continues) {
  const auto compiled = scene;
  const Document prepared_document = document_with(document, "path");
  PreparedDocument prepared(prepared_document, std::move(scene));
  if (!prepared.refusal().empty()) return input_error("camera paths: " + prepared.refusal());
  ThreadPool workers(threads);
  const size_t nodes = compiled->description().nodes.size();
  ImportancePaths paths =
      trace_importance(prepared, prepared_document, nodes, std::max(samples, 2u), workers, continues);
  if (!continues()) return input_error("the audit was interrupted");
  ImportanceAudit audit;
  for (size_t node = 0; node < nodes; ++node) {
    const Measured importance =
        measured(paths.by_object, [&](const std::vector<double>& batch) { return batch[node]; });
    if (importance.value > 0)
      audit.objects.push_back({name_of(*compiled, node), static_cast<uint32_t>(node), importance});
  }
  std::ranges::stable_sort(audit.objects, std::greater(), [](const auto& object) { return object.importance.value; });
  const Bounds bounds = compiled->bounds();
  if (!(radius > 0)) radius = static_cast<float>(kKernelFraction) * glm::distance(bounds.min, bounds.max);
  const double count = static_cast<double>(paths.by_object.size()) * document.width * document.height;
  const integrator::ImportanceMap map(std::move(paths.vertices), count, radius);
  audit.picture = density_picture(map, *compiled, document, view, workers, continues);
  return audit;
}

}  // namespace etendue::render
