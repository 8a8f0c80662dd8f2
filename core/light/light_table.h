// All lights of a compiled scene, and choosing among them.                    thesis 6.4, 9.1.2; (9.21)-(9.23)
//
// A light is an emissive triangle, a point, spot or directional light, or the environment. A sample carries its density
// with its measure: per solid angle at the receiver for what has an extent, discrete for what has none.
//
// Lights that move while the shutter is open are sampled where they are at the time that is asked for, and chosen by
// their power halfway, or by the tree for wherever they may be.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "base/parameter.h"
#include "base/piecewise_constant.h"
#include "base/vectorize.h"
#include "base/warp.h"
#include "geometry/analytic_shape.h"
#include "geometry/motion.h"
#include "light/light.h"
#include "light/light_tree.h"
#include "spectrum/rgb.h"

namespace etendue {

// An emissive triangle in world space, or a whole sphere or disk in the place of one. Radiance is the emission of its
// material, the mean of it over a texture: only for choosing; what is shaded comes from the material itself.
struct AreaLightTriangle {
  Vec3 p0, e1, e2;
  uint32_t instance = 0, triangle = 0;
  Rgb radiance{0};
  bool double_sided = false;
  bool textured = false;  // what is shaded varies over the triangle
  bool moving = false;    // then this is where it is halfway through the shutter
  Vec3 cross{0};          // of the edges, pointing to the front: as long as twice the area
  Vec3 normal{0};         // the same, of unit length
  float area = 0;
  float cosine_exponent = 0;  // radiance falls off from the normal as this power of the cosine
  int round = kFlat;          // index into LightTable's round shapes; of the rest only the area counts then
  static constexpr int kFlat = -1;

  float beam(float cosine) const { return cosine_exponent == 0 ? 1 : std::pow(std::abs(cosine), cosine_exponent); }
  // Half of what a double-sided triangle sends goes either way.
  float side_probability() const { return double_sided ? 0.5f : 1.0f; }
  void place(const Facet& facet) {
    p0 = facet.p0, e1 = facet.p1 - p0, e2 = facet.p2 - p0;
    cross = glm::cross(e1, e2) * facet.winding;
    const float twice = glm::length(cross);
    normal = cross / twice, area = 0.5f * twice;
  }
  // A sphere or disk: it always looks large, and so is sampled on its own.
  void place_round(int index, const RoundShape& shape) {
    round = index, p0 = shape.centre, e1 = e2 = Vec3(0), cross = Vec3(kEndless, 0, 0);
    normal = shape.frame.z, area = shape.area();
  }

 private:
  static constexpr float kEndless = 1e20f;  // its square is no float
};

// What tells where the moving triangles of an instance are.
struct MovingEmitter {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const Motion> motion;
};

// A light that is a sphere or a disk, halfway through the shutter.
struct RoundLight {
  RoundShape shape;
  std::shared_ptr<const Motion> motion = nullptr;  // of its node; null if it stands still

  RoundShape at(float time) const { return motion ? shape.placed(motion->matrix_at(time)) : shape; }
};

struct LightPlace {
  Vec3 position{0}, direction{0, 0, -1};

  LightPlace() = default;
  explicit LightPlace(const Mat4& node) : position(node[3]), direction(normalize_or(-Vec3(node[2]), Vec3(0, 0, -1))) {}
};

struct PlacedLight {
  Light light;
  LightPlace place;                                // halfway through the shutter
  std::shared_ptr<const Motion> motion = nullptr;  // of its node; null if it stands still

  LightPlace at(float time) const { return motion ? LightPlace(motion->matrix_at(time)) : place; }
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
  Vec3 wi{0};                  // towards the light
  float distance = kInfinity;  // 0: nothing can lie in between
  float pdf = 0;          // of this sample, choice of the light included: per solid angle, or discrete where `delta`
  bool delta = false;     // nothing else finds it
  bool textured = false;  // `radiance` is only the mean over the triangle: ask the scene for what it is here
  Rgb radiance{0};        // what arrives, without visibility; for a delta light, irradiance on a facing surface
  uint32_t light = 0;
  Vec2 barycentric{0};  // on a triangle; u and v on a round shape
};

// Where a ray that leaves a light comes from, and how densely such rays lie.
//
// The two densities belong to the ray's two ends, in the order in which a walk from the light finds them: of a surface
// the point (per area) and the direction (per solid angle), of a point light the point (discrete) and the direction. Of
// what is infinitely far away the direction comes first (per solid angle; discrete for a directional light), then the
// point that the ray passes through (per area of a plane across it).
struct EmissionDensity {
  float first = 0, second = 0;
  bool delta = false;     // the light has no extent: no walk ends on it
  bool infinite = false;  // it is infinitely far away
};

// A ray that leaves a light.
struct Emission {
  LightKind kind = LightKind::triangle;
  uint32_t light = 0;
  Vec2 barycentric{0};    // on a triangle; u and v on a round shape
  bool back = false;      // it leaves the back of a triangle
  Vec3 position{0};       // of a point light; a point outside of the scene where the light is infinitely far away
  Vec3 direction{0};      // unit; of a triangle, in the frame of the side that it leaves
  bool textured = false;  // `radiance` is only the mean over the triangle: ask the scene for what it is here
  Rgb radiance{0};        // of a point light intensity, of a directional one irradiance
  float time = 0;         // from 0 at the shutter's opening to 1 at its closing
  float weight = 0;       // the cosine over both densities: times the radiance, the watts that this ray stands for
  EmissionDensity density;
};

// The random numbers of one emission, each in [0, 1). Most lights want the direction under a cosine: it is cheaper to
// compute for many rays at once.
struct EmissionDraw {
  float choice;
  Vec2 point, direction;
  float time;
  Vec3 cosine_direction;

  EmissionDraw(float choice_, Vec2 point_, Vec2 direction_, float time_ = 0)
      : EmissionDraw(choice_, point_, direction_, time_, square_to_cosine_hemisphere(direction_)) {}
  EmissionDraw(float choice_, Vec2 point_, Vec2 direction_, float time_, const Vec3& cosine_direction_)
      : choice(choice_), point(point_), direction(direction_), time(time_), cosine_direction(cosine_direction_) {}
};

// Where light is asked for, and the random numbers to find some: arrays with room for whole registers.
struct LightQueries {
  WideVec3View from;
  const float *choice, *u0, *u1;
  size_t count;
  const float* times = nullptr;  // from 0 at the shutter's opening to 1 at its closing; null where no light moves
};

// How the lights that are asked are chosen: one at a time by its power, or every one: the sum over lights (thesis 8.2;
// E3), or one by what it may bring to the receiver's place (light_tree.h), or whichever of the single ones suits the
// scene.
//
// All but `emission_pdf` find points on large triangles near by through the solid angle that they subtend; that one
// finds them as `emit` does, one by its power and any of its points alike, for weights that rely on it.
enum class LightStrategy : uint8_t { one, every, tree, automatic, emission_pdf };

class LightTable {
 public:
  LightTable() = default;
  // `movers` has an entry for each instance if any of the triangles moves; `rounds` is what triangles may refer to.
  LightTable(std::vector<AreaLightTriangle> triangles, std::vector<PlacedLight> placed, const Environment& environment,
             const Bounds& scene_bounds, std::vector<MovingEmitter> movers = {}, std::vector<RoundLight> rounds = {});

  bool empty() const { return choice_.empty(); }
  size_t size() const { return choice_.size(); }
  const std::vector<AreaLightTriangle>& triangles() const { return triangles_; }
  const std::vector<PlacedLight>& placed() const { return placed_; }
  const EnvironmentMap& environment() const { return environment_; }

  // What `use` makes of a triangle where it is at that time.
  template <class Use>
  auto with_triangle(uint32_t light, float time, Use&& use) const {
    const AreaLightTriangle& t = triangles_[light];
    return t.moving ? use(moved(t, time)) : use(t);
  }

  // The normal at a point of it that has these barycentric weights, or these numbers on a round shape.
  Vec3 normal_at(uint32_t light, Vec2 at, float time) const {
    const AreaLightTriangle& t = triangles_[light];
    if (t.round >= 0) return round_of(t).at(time).normal_at(at);
    return t.moving ? moved(t, time).normal : t.normal;
  }

  // One sample each, by one of the strategies that take a single light. Its density is 0 if the light cannot send
  // anything there (a triangle seen edge-on, a spot that looks away) or if there is no light at all.
  void sample(const LightQueries& queries, LightSample* samples, LightStrategy strategy) const;

  // Lights as a user counts them: the emissive triangles of an instance are one source, so are a placed light and the
  // environment. Those without power are none.
  size_t sources() const { return sources_.size(); }
  // As `sample`, on one source: only the point on it is chosen.
  void sample_source(size_t source, const LightQueries& queries, LightSample* samples) const;

  // Densities with which samples by the strategy would have found, from there, a direction that was found otherwise,
  // per solid angle. With every light these are densities of its source's own sample.
  float pdf_triangle(uint32_t light, const Vec3& from, const Vec3& at, float time, LightStrategy strategy) const;
  float pdf_environment(const Vec3& direction, LightStrategy strategy) const;
  // The probability of the light itself.
  float probability(uint32_t light, const Vec3& from, LightStrategy strategy) const;

  // A ray that leaves some light; of power zero if there is none. `e` is a new one.
  void emit(const EmissionDraw& draw, Emission& e) const;
  Emission emit(const EmissionDraw& draw) const {
    Emission e;
    return emit(draw, e), e;
  }
  // The same with another direction from the same point; from infinity, through another point from the same direction.
  // `e` needs no more than its kind, light, position and, from infinity, direction.
  void resample_emission(Vec2 u, Emission& e) const;
  // The densities with which `emit` finds a ray that was found otherwise: one that connects to a sample; one along
  // which a walk came to a triangle, its cosine there to the normal; one that a walk left the scene by.
  EmissionDensity emission_density(const LightSample& sample, float time = 0) const {
    return sample.kind == LightKind::triangle ? emission_density(sample.light, cosine_at(sample, time), time)
                                              : density_of_other(sample);
  }
  EmissionDensity emission_density(uint32_t light, float cosine, float time = 0) const {
    if (choice_.empty() || light >= triangles_.size()) return {};
    return with_triangle(light, time, [&](const AreaLightTriangle& t) {
      return EmissionDensity{choice_.probability(light) / t.area,
                             t.side_probability() * pdf_of_cosine(t, std::abs(cosine))};
    });
  }
  EmissionDensity environment_emission_density(const Vec3& direction) const;
  // What is left of a light's emission after so many metres; glTF's punctual lights may have a range.
  float range_window(uint32_t light, float distance) const;

 private:
  struct ChosenTriangles;
  // `choose` turns a random number into a light and its probability.
  template <class Choose>
  void sample_chosen(const LightQueries& queries, LightSample* samples, bool solid_angles, Choose&& choose) const;
  template <class Choose>
  void sample_batch(const LightQueries& queries, ChosenTriangles& triangles, LightSample* samples, bool solid_angles,
                    Choose&& choose) const;
  bool sample_placed(const PlacedLight& light, const Vec3& from, Vec2 u, float time, LightSample& sample) const;
  void sample_other(const AliasTable::Choice& choice, const Vec3& from, Vec2 u, float time, LightSample& sample) const;
  bool sample_environment(Vec2 u, LightSample& sample) const;

  void emit_from_triangle(const EmissionDraw& draw, Emission& e) const;
  void emit_from_point(const AliasTable::Choice& choice, const EmissionDraw& draw, Emission& e) const;
  void emit_from_infinity(const AliasTable::Choice& choice, const EmissionDraw& draw, Emission& e) const;
  void leave_triangle(const Vec2& u, const Vec3& cosine_direction, Emission& e) const;
  void leave_point(Vec2 u, Emission& e) const;
  void come_from_infinity(Vec2 u, Emission& e) const;
  AreaLightTriangle moved(const AreaLightTriangle& triangle, float time) const;
  // Of a point on a triangle.
  float cosine_at(const LightSample& sample, float time) const {
    return glm::dot(normal_at(sample.light, sample.barycentric, time), sample.wi);
  }
  // Of a direction that leaves a side of it, per solid angle: what it sends there, cosine included.
  static float pdf_of_cosine(const AreaLightTriangle& t, float cosine) {
    return t.cosine_exponent == 0 ? cosine * kInvPi
                                  : (t.cosine_exponent + 2) * 0.5f * kInvPi * std::pow(cosine, t.cosine_exponent + 1);
  }
  const RoundLight& round_of(const AreaLightTriangle& t) const { return rounds_[static_cast<size_t>(t.round)]; }
  void sample_round(const AreaLightTriangle& t, float probability, const Vec3& from, Vec2 u, float time,
                    bool solid_angles, LightSample& sample) const;
  float pdf_of_point_on_round(const AreaLightTriangle& t, const Vec3& from, const Vec3& at, float time,
                              bool solid_angles) const;
  EmissionDensity density_of_other(const LightSample& sample) const;
  float pdf_across() const { return 1 / (kPi * sqr(radius_)); }
  // Neighbours in the order of `choice_`.
  struct Source {
    uint32_t first, count;
    float probability;  // of `sample` choosing one of them
  };
  uint32_t environment_light() const { return static_cast<uint32_t>(choice_.size() - 1); }
  bool is_infinite(uint32_t light) const;
  void plant_tree(std::span<const float> powers);
  LightBounds bounds_of(uint32_t light) const;
  bool uses_tree(LightStrategy strategy) const {
    return strategy == LightStrategy::tree || (strategy == LightStrategy::automatic && many_);
  }
  AliasTable::Choice choose_by_tree(const Vec3& from, float u) const;
  float probability_by_tree(uint32_t light, const Vec3& from) const;
  float probability_of_infinite(uint32_t light) const;
  void find_sources();
  size_t source_of(uint32_t light) const;
  AliasTable::Choice choose_within(const Source& source, float u) const;

  std::vector<AreaLightTriangle> triangles_;
  std::vector<PlacedLight> placed_;
  std::vector<MovingEmitter> movers_;
  std::vector<RoundLight> rounds_;
  Vec3 centre_{0};    // of a sphere around
  float radius_ = 1;  // the scene
  EnvironmentMap environment_;
  AliasTable choice_;  // triangles, then placed lights, then the environment if there is one
  std::vector<Source> sources_;
  std::vector<float> mass_;  // probability of a triangle and those of its source before it

  // What is infinitely far away has no place in the tree: a share of all choices goes there, by power.
  LightTree tree_;
  std::vector<uint32_t> infinite_;
  AliasTable infinite_choice_;
  float infinite_share_ = 0;
  bool many_ = false;  // lights enough for the tree to pay
};

}  // namespace etendue

template <>
struct etendue::Options<etendue::LightStrategy> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"one", "One, chosen by its power"},
                                                            {"every", "Every light"},
                                                            {"tree", "One, chosen by what it may bring"},
                                                            {"auto", "One, by the tree where there are many"}}};
};
