// A record of the paths of one pixel sample: vertices, light samples, BSDF samples, densities, weights and
// contributions.
//
// An integrator that traces paths from the camera fills the record while it samples a block of pixels
// (integrator::TaskContext::recorder). Recording changes neither random numbers nor arithmetic, and the contributions
// are stored as they were added. Their sum is therefore bit-identical to the sample of the pixel.
//
// Paths of a wavefront have numbers that change when branches are resumed. The recorder follows the paths of its pixel
// by these numbers and ignores all other paths.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "bsdf/lobe.h"
#include "sampling/sampler.h"
#include "scene/compiled_scene.h"

namespace etendue::transport {

// Why a BSDF sample does not continue its path.
enum class PathEnd : uint8_t {
  none,      // it does continue
  absorbed,  // no direction was sampled
  excluded,  // no continuation belongs to the selected path classes
  roulette,  // Russian roulette, or a throughput below the cutoff of the integrator
};

struct Roulette {
  float survival = 1;  // probability
  float random = 0;    // the path survives if this number is below `survival`
};

// A light sample at a vertex (next event estimation).
struct RecordedLight {
  LightSample sample;
  Rgb radiance{0};     // of the sample, without occlusion
  Rgb f_cos{0};        // BSDF times cosine, of the selected path classes
  float bsdf_pdf = 0;  // density with which the BSDF samples this direction, 1/sr
  float mis_weight = 1;
  Rgb unoccluded{0};  // contribution without the transmittance of the shadow ray
  bool shadow_ray = false;
  bool occluded = false;
  Rgb contribution{0};  // that was added
};

// A BSDF sample at a vertex.
struct RecordedScattering {
  LobeSample<Rgb> sample;
  std::optional<Roulette> roulette = std::nullopt;
  PathEnd end = PathEnd::none;
  Rgb throughput{0};  // after it
};

// Light that a path finds by itself: the emission of a surface that it hits, or the environment.
struct RecordedEmission {
  Rgb radiance{0};
  float mis_weight = 1;
  Rgb contribution{0};
};

// A vertex of a path. A path that left the scene ends with a vertex that has no surface point.
struct RecordedVertex {
  int parent = -1;      // index of the previous vertex; -1: the camera
  int scattering = -1;  // the BSDF sample of the parent that leads here
  int length = 0;       // number of edges from the camera
  bool escaped = false;
  scene::SurfacePoint point;                               // undefined if `escaped`
  Vec3 origin{0};                                          // of the segment
  Vec3 wo{0, 0, 1};                                        // reverse direction of the segment
  Rgb throughput{0};                                       // on arrival, after absorption along the segment
  bool diffuse = false, glossy = false, specular = false;  // the types of its lobes
  std::optional<RecordedEmission> emission = std::nullopt;
  std::optional<RecordedEmission> medium_emission = std::nullopt;  // of media on the segment
  std::vector<RecordedLight> lights = {};
  std::vector<RecordedScattering> scattering_samples = {};
};

struct PathRecord {
  Vec2 raster{0};                           // position in the image, in pixels
  std::optional<Vec2> lens = std::nullopt;  // random numbers of the point on the lens
  float time = 0;
  Ray camera_ray;
  std::vector<RecordedVertex> vertices;
  // The radiance of the sample. It is the sum of the contributions, added in the order of the rendering: separately for
  // each path that was traced in a wavefront, then over these paths.
  Rgb radiance{0};
};

class PathRecorder {
 public:
  // Records the paths of this pixel of the image.
  explicit PathRecorder(Vec2i pixel) : pixel_(pixel) {}

  Vec2i pixel() const { return pixel_; }
  const PathRecord& record() const { return record_; }

  // Starts with a path of the wavefront. All of the following functions do nothing for paths of other pixels.
  void start(int path, Vec2 raster, std::optional<Vec2> lens, float time, const Ray& ray);
  bool records(int path) const { return tips_[static_cast<size_t>(path)].recorded; }

  void arrive(int path, int length, const scene::SurfacePoint& point, const Vec3& wo, const Rgb& throughput);
  void set_lobes(int path, bool diffuse, bool glossy, bool specular);
  void escape(int path, int length, const Vec3& direction, const Rgb& throughput);

  // Emission or environment light that was added to the radiance of the path.
  void add_emission(int path, const RecordedEmission& emission);
  // Emission of media on the segment that ends at the last vertex.
  void add_medium_emission(int path, const RecordedEmission& emission);
  // A light sample. `connection` is the number of its shadow ray, or -1 if there is none, and it has been added.
  void add_light(int path, const RecordedLight& light, int connection);
  // The result of a shadow ray. `contribution` was added to the radiance of the path.
  void resolve(int connection, bool occluded, const Rgb& contribution);

  void scatter(int path, const LobeSample<Rgb>& sample);
  // The following functions concern the last BSDF sample of the path.
  void play_roulette(int path, const Roulette& roulette);
  void end(int path, PathEnd reason);
  void set_throughput(int path, const Rgb& throughput);

  // Branches, queued by their number of edges and resumed in reverse order. `root` is the path whose tree they belong
  // to.
  void queue_branch(int path, int length);
  void resume_branch(int path, int length, int root);
  // All paths of the wavefront have ended; their radiance is added to the sample in the order of their numbers.
  void collect(int paths);

 private:
  // The end of a path of the wavefront.
  struct Tip {
    bool recorded = false;
    int vertex = -1;      // the last one; -1: the camera
    int scattering = -1;  // of that vertex, on which the path continues
  };
  struct Shadow {
    int connection, path, vertex;
    size_t light;
  };

  RecordedVertex& vertex_of(int path) {
    return record_.vertices[static_cast<size_t>(tips_[static_cast<size_t>(path)].vertex)];
  }
  RecordedVertex& add_vertex(int path, int length, const Vec3& wo, const Rgb& throughput);
  void add(int path, const Rgb& contribution) { radiance_[static_cast<size_t>(path)] += contribution; }

  Vec2i pixel_;
  int root_ = -1;  // the path that `start` was called for
  PathRecord record_;
  std::array<Tip, SampleTable::kPaths> tips_;
  std::array<Rgb, SampleTable::kPaths> radiance_;  // of the paths of the wavefront, if recorded
  std::vector<Shadow> shadows_;                    // pending
  std::vector<std::vector<Tip>> queued_;           // by number of edges
};

}  // namespace etendue::transport
