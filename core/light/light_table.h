// All lights of a compiled scene, and choosing among them by power.           thesis 6.4, 9.1.2; (9.21)-(9.23)
//
// A light is an emissive triangle, a point, spot or directional light, or the environment. A sample carries its density
// with its measure: per solid angle at the receiver for what has an extent, discrete for what has none.
//
// Lights that move while the shutter is open are sampled where they are at the time that is asked for, and chosen by
// their power halfway.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "base/distribution.h"
#include "base/wide.h"
#include "geometry/motion.h"
#include "light/light.h"
#include "spectrum/rgb.h"

namespace etendue {

// An emissive triangle in world space. Radiance is the emission of its material, the mean of it over a texture: only
// for choosing; what is shaded comes from the material itself.
struct EmissiveTriangle {
  Vec3 p0, e1, e2;
  uint32_t instance = 0, triangle = 0;
  Rgb radiance{0};
  bool double_sided = false;
  bool textured = false;  // what is shaded varies over the triangle
  bool moving = false;    // then this is where it is halfway through the shutter
  Vec3 cross{0};          // of the edges, pointing to the front: as long as twice the area

  float area() const { return 0.5f * glm::length(cross); }
  void place(const Facet& facet) {
    p0 = facet.p0, e1 = facet.p1 - p0, e2 = facet.p2 - p0;
    cross = glm::cross(e1, e2) * facet.winding;
  }
};

// What tells where the moving triangles of an instance are.
struct MovingEmitter {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const Motion> motion;
};

struct PlacedLight {
  Light light;
  Vec3 position{0}, direction{0, 0, -1};
  std::shared_ptr<const Motion> motion = nullptr;  // of its node; null if it stands still

  void place(const Mat4& node) {
    position = Vec3(node[3]);
    direction = normalize_or(-Vec3(node[2]), Vec3(0, 0, -1));
  }
};

// The environment ready for sampling.
class EnvironmentMap {
 public:
  EnvironmentMap() = default;
  explicit EnvironmentMap(const Environment& environment);

  bool black() const { return environment_.black(); }
  bool visible() const { return environment_.visible; }
  Rgb radiance(const Vec3& direction) const;
  struct Sample {
    Vec3 direction;
    float pdf_solid_angle;
  };
  Sample sample(Vec2 u) const;
  float pdf_solid_angle(const Vec3& direction) const;
  Rgb mean_radiance() const { return mean_; }

 private:
  Vec2 uv_of(const Vec3& direction) const;
  Environment environment_;
  std::vector<float> weights_;  // of the map's texels: luminance times sine; empty for a constant environment
  Piecewise2D density_;         // of the patches between them
  Rgb mean_{0};
};

enum class LightKind : uint8_t { triangle, placed, environment };

// A point on a light as a receiver sees it.
struct LightSample {
  LightKind kind = LightKind::triangle;
  Vec3 wi{0};  // towards the light
  float distance = kInfinity;
  float pdf = 0;  // of this sample, choice of the light included: per solid angle, or discrete where `delta`
  bool delta = false;
  bool textured = false;  // `radiance` is only the mean over the triangle: ask the scene for what it is here
  Rgb radiance{0};        // what arrives, without visibility; for a delta light, irradiance on a facing surface
  uint32_t light = 0;
  Vec2 barycentric{0};  // on a triangle
};

// Where light is asked for, and the random numbers to find some: arrays with room for whole registers.
struct LightQueries {
  WideVec3View from;
  const float *choice, *u0, *u1;
  size_t count;
  const float* times = nullptr;  // from 0 at the shutter's opening to 1 at its closing; null where no light moves
};

class LightTable {
 public:
  LightTable() = default;
  // `movers` has an entry for each instance if any of the triangles moves.
  LightTable(std::vector<EmissiveTriangle> triangles, std::vector<PlacedLight> placed, const Environment& environment,
             const Bounds& scene_bounds, std::vector<MovingEmitter> movers = {});

  bool empty() const { return choice_.empty(); }
  size_t size() const { return choice_.size(); }
  const std::vector<EmissiveTriangle>& triangles() const { return triangles_; }
  const std::vector<PlacedLight>& placed() const { return placed_; }
  const EnvironmentMap& environment() const { return environment_; }

  // One sample each. Its density is 0 if the light cannot send anything there (a triangle seen edge-on, a spot
  // that looks away) or if there is no light at all.
  void sample(const LightQueries& queries, LightSample* samples) const;

  // Densities with which `sample` would have produced a direction that was found otherwise, per solid angle.
  float pdf_triangle(uint32_t light, const Vec3& from, const Vec3& at, float time = 0) const;
  float pdf_environment(const Vec3& direction) const;

 private:
  struct ChosenTriangles;
  void sample_batch(const LightQueries& queries, ChosenTriangles& triangles, LightSample* samples) const;
  bool sample_placed(const PlacedLight& light, const Vec3& from, const float* time, LightSample& sample) const;
  void sample_other(const AliasTable::Choice& choice, const Vec3& from, Vec2 u, const float* time,
                    LightSample& sample) const;
  EmissiveTriangle triangle_at(uint32_t light, float time) const;
  bool sample_environment(Vec2 u, LightSample& sample) const;

  std::vector<EmissiveTriangle> triangles_;
  std::vector<PlacedLight> placed_;
  std::vector<MovingEmitter> movers_;
  EnvironmentMap environment_;
  AliasTable choice_;  // triangles, then placed lights, then the environment if there is one
};

}  // namespace etendue
