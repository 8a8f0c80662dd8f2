// A pool with waves over a tiled floor, seen from above under a small light. The water refracts all light on its way to
// the floor and back to the camera: the paths are E S D S L.
#pragma once
#include "scene/builtin/builtin.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {
namespace pool {

inline constexpr float kHalf = 2, kFloor = -1, kLevel = -0.12f, kRim = 0.5f;  // metres

// Height of the water surface above kLevel, and its derivatives.
struct Wave {
  float height = 0, dx = 0, dz = 0;
};
inline Wave wave_at(float x, float z) {
  struct Ripple {
    float kx, kz, phase, height;
  };
  constexpr Ripple kRipples[] = {{3.1f, 1.2f, 0.4f, 0.016f},
                                 {-1.7f, 4.2f, 2.1f, 0.012f},
                                 {5.3f, -3.6f, 4.0f, 0.006f},
                                 {2.4f, 6.8f, 1.3f, 0.004f},
                                 {-7.9f, -2.2f, 5.2f, 0.003f}};
  Wave wave;
  for (const Ripple& r : kRipples) {
    const float phase = r.kx * x + r.kz * z + r.phase;
    wave.height += r.height * std::sin(phase);
    wave.dx += r.height * r.kx * std::cos(phase);
    wave.dz += r.height * r.kz * std::cos(phase);
  }
  return wave;
}

// A closed mesh. Its sides and bottom are inside the walls and the floor, so that only its top surface is visible.
inline std::shared_ptr<const Mesh> water() {
  constexpr int kCells = 128;
  constexpr float kReach = kHalf + 0.4f * kRim, kBottom = kFloor - 0.2f;
  auto mesh = std::make_shared<Mesh>();
  const auto add_vertex = [&](const Vec3& p, const Vec3& n) {
    mesh->positions.push_back(p);
    mesh->normals.push_back(n);
    return static_cast<uint32_t>(mesh->positions.size()) - 1;
  };
  const auto at = [](int i, int j) { return static_cast<uint32_t>(j * (kCells + 1) + i); };
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i) {
      const float x = kReach * (2.0f * static_cast<float>(i) / kCells - 1);
      const float z = kReach * (2.0f * static_cast<float>(j) / kCells - 1);
      const Wave wave = wave_at(x, z);
      add_vertex({x, kLevel + wave.height, z}, glm::normalize(Vec3(-wave.dx, 1, -wave.dz)));
    }
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      mesh->triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh->triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  // The vertices of the edge, counter-clockwise from above.
  std::vector<uint32_t> edge;
  for (int k = 0; k < kCells; ++k) edge.push_back(at(0, k));
  for (int k = 0; k < kCells; ++k) edge.push_back(at(k, kCells));
  for (int k = kCells; k > 0; --k) edge.push_back(at(kCells, k));
  for (int k = kCells; k > 0; --k) edge.push_back(at(k, 0));
  const uint32_t middle = add_vertex({0, kBottom, 0}, {0, -1, 0});
  for (size_t k = 0; k < edge.size(); ++k) {
    const Vec3 a = mesh->positions[edge[k]], b = mesh->positions[edge[(k + 1) % edge.size()]];
    const Vec3 c(a.x, kBottom, a.z), d(b.x, kBottom, b.z), out = glm::normalize(glm::cross(a - b, c - b));
    const uint32_t va = add_vertex(a, out), vb = add_vertex(b, out), vc = add_vertex(c, out), vd = add_vertex(d, out);
    mesh->triangles.push_back({va, vc, vd});
    mesh->triangles.push_back({va, vd, vb});
    const uint32_t below_c = add_vertex(c, {0, -1, 0}), below_d = add_vertex(d, {0, -1, 0});
    mesh->triangles.push_back({middle, below_d, below_c});
  }
  mesh->positions.reserve(mesh->positions.size() + 1);
  return mesh;
}

// Every other square of a checkerboard on the floor.
inline std::shared_ptr<const Mesh> tiles(bool odd) {
  constexpr int kTiles = 10;
  constexpr float kSide = 2 * kHalf / kTiles;
  auto mesh = std::make_shared<Mesh>();
  mesh->positions.reserve(kTiles * kTiles * 2 + 1);
  for (int j = 0; j < kTiles; ++j)
    for (int i = 0; i < kTiles; ++i) {
      if ((i + j) % 2 != (odd ? 1 : 0)) continue;
      const auto first = static_cast<uint32_t>(mesh->positions.size());
      const float x = static_cast<float>(i) * kSide - kHalf, z = static_cast<float>(j) * kSide - kHalf;
      for (const Vec2 corner : {Vec2(0, 0), Vec2(0, 1), Vec2(1, 1), Vec2(1, 0)})
        mesh->positions.emplace_back(x + corner.x * kSide, kFloor, z + corner.y * kSide);
      mesh->triangles.push_back({first, first + 1, first + 2});
      mesh->triangles.push_back({first, first + 2, first + 3});
    }
  return mesh;
}

inline void add_basin(Scene& scene) {
  add(scene, "light tiles", tiles(false), add_diffuse(scene, "light tiles", {0.75f, 0.78f, 0.76f}));
  add(scene, "dark tiles", tiles(true), add_diffuse(scene, "dark tiles", {0.25f, 0.5f, 0.6f}));
  const int stone = add_diffuse(scene, "stone", {0.6f, 0.55f, 0.48f});
  constexpr float kFar = kHalf + kRim, kDeep = kFloor - 0.4f;
  add_box(scene, "left rim", stone, {-kFar, kDeep, -kFar}, {-kHalf, 0, kFar});
  add_box(scene, "right rim", stone, {kHalf, kDeep, -kFar}, {kFar, 0, kFar});
  add_box(scene, "back rim", stone, {-kHalf, kDeep, -kFar}, {kHalf, 0, -kHalf});
  add_box(scene, "front rim", stone, {-kHalf, kDeep, kHalf}, {kHalf, 0, kFar});
}

}  // namespace pool

inline Scene caustic_pool() {
  Scene scene;
  scene.name = "Caustic pool";
  pool::add_basin(scene);
  add(scene, "water", pool::water(), add_glass(scene, "water", 1.33f));
  add(scene, "light", ball(0.25f, 16), add_emitter(scene, "light", Rgb(620, 570, 490)),
      translated({1.4f, 4.6f, -2.6f}));
  // Hidden at first. When visible, its light is easy to find.
  add(scene, "fill light", rectangle({-6, 7, -6}, {12, 0, 0}, {0, 0, 12}), add_emitter(scene, "fill light", Rgb(1)))
      .visible = false;

  Camera camera = look_at({0, 6.3f, 3.9f}, {0, -0.5f, 0.05f}, {0, 1, 0}, 0.64f);
  camera.aspect = 1;
  add(scene, camera);
  return scene;
}

inline constexpr Builtin kCausticPool{
    .name = "caustic-pool",
    .label = "Caustic pool",
    .doc =
        "Light reaches the floor and the camera only through water: photon methods find these paths, connections do "
        "not; the hidden node 'fill light' makes the scene easy",
    .make = caustic_pool,
};

}  // namespace etendue::scene
