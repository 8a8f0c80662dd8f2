#include "scene/shutter.h"

#include <bit>

#include "scene/pose.h"

namespace etendue::scene {
namespace {

// Largest deviation of a linear segment from the exact motion, relative to the radius of the object: an eighth of a
// pixel for an object 1000 pixels wide.
constexpr float kTolerance = 1.0f / 4096;

// Largest number of vertices of one mesh over all its time steps.
constexpr size_t kMaxVertices = size_t{1} << 24;

std::array<Vec3, 8> corners_of(const Mesh& mesh) {
  const Bounds b = bounds_of(mesh, Mat4(1));
  std::array<Vec3, 8> corners;
  for (size_t i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z};
  return corners;
}

float radius_of(const std::array<Vec3, 8>& corners, const Mat4& to_world) {
  Bounds bounds;
  for (const Vec3& c : corners) bounds.extend(Vec3(to_world * Vec4(c, 1)));
  return bounds.radius();
}

// The position of a moment between two others, 0 to 1.
float fraction_of(int moment, int before, int after) {
  return static_cast<float>(moment - before) / static_cast<float>(after - before);
}

// The largest distance of a point from its linear interpolation.
float largest_deviation(const std::vector<Vec3>& a, const std::vector<Vec3>& b, float fraction,
                        const std::vector<Vec3>& exact) {
  float squared = 0;
  for (size_t i = 0; i < exact.size(); ++i)
    squared = std::max(squared, length_squared(a[i] * (1 - fraction) + b[i] * fraction - exact[i]));
  return std::sqrt(squared);
}

}  // namespace

Shutter::Shutter(const Scene& scene, float seconds) : scene_(scene), seconds_(seconds) {
  if (seconds_ > 0) find_animated();
}

float Shutter::time(int moment) const {
  return scene_.time + seconds_ * (static_cast<float>(moment) / static_cast<float>(kSegments));
}

const std::vector<Mat4>& Shutter::world(int moment) {
  auto& matrices = worlds_[moment];
  if (matrices.empty()) matrices = world_matrices(scene_, time(moment));
  return matrices;
}

void Shutter::find_animated() {
  const float opens = time(0), closes = time(kSegments);
  std::vector<bool> moved(scene_.nodes.size(), false);
  morphing_.assign(scene_.nodes.size(), false);
  bool any = false;
  for_each_channel(scene_, [&](const AnimationChannel& channel) {
    // A channel is constant outside its keyframes.
    if (!(channel.times.front() < closes && channel.times.back() > opens)) return;
    any = true;
    (channel.path == AnimatedPath::weights ? morphing_ : moved)[static_cast<size_t>(channel.node)] = true;
    for (size_t k = 1; k < channel.times.size(); ++k)
      if (channel.times[k] > opens && channel.times[k - 1] < closes)
        resolution_ = std::max(resolution_, resolution_for(channel.times[k] - channel.times[k - 1]));
  });
  if (!any) return;
  moving_ = moved;
  for (size_t i = 0; i < moved.size(); ++i)
    for (int node = scene_.nodes[i].parent; node >= 0; node = scene_.nodes[static_cast<size_t>(node)].parent)
      if (moved[static_cast<size_t>(node)]) moving_[i] = true;
}

// The resolution that samples an interval of `span` seconds twice.
int Shutter::resolution_for(float span) const {
  const float samples = std::clamp(2 * seconds_ / span, 1.0f, static_cast<float>(kSegments));
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(samples))));
}

bool Shutter::is_animated(int node) const { return !moving_.empty() && moving_[static_cast<size_t>(node)]; }

bool Shutter::changes_shape(int node, const Primitive& primitive) const {
  if (moving_.empty() || !primitive.deformation) return false;
  if (morphing_[static_cast<size_t>(node)]) return true;
  if (!is_skinned(scene_, node, primitive)) return false;
  const auto skin = static_cast<size_t>(scene_.nodes[static_cast<size_t>(node)].skin);
  return std::ranges::any_of(scene_.skins[skin]->joints, [&](int joint) { return is_animated(joint); });
}

bool Shutter::is_static(int node) {
  if (!is_animated(node)) return true;
  const Mat4 first = world(0, node);
  for (int k = 1; k <= resolution_; ++k)
    if (world(k * (kSegments / resolution_), node) != first) return false;
  return true;
}

// The number of sampled moments, of resolution_ + 1, at which the world matrix is singular.
int Shutter::count_singular(int node) {
  int count = 0;
  for (int k = 0; k <= resolution_; ++k) count += is_singular(world(k * (kSegments / resolution_), node));
  return count;
}

// The smallest number of linear segments, a power of two and at most `limit`, for which is_linear(moment, before,
// after) holds at all sampled moments between the ends of each segment.
template <class IsLinear>
int Shutter::segments_for(int limit, IsLinear&& is_linear) const {
  for (int segments = 1; segments < limit; segments *= 2) {
    const int length = kSegments / segments, step = kSegments / std::max(resolution_, 2 * segments);
    bool linear = true;
    for (int before = 0; before < kSegments && linear; before += length)
      for (int k = before + step; k < before + length && linear; k += step)
        linear = is_linear(k, before, before + length);
    if (linear) return segments;
  }
  return limit;
}

std::optional<Shutter::Moving> Shutter::moving(int node, const Primitive& primitive) {
  const bool deforms = changes_shape(node, primitive);
  // The joints alone place a skinned mesh.
  const bool skinned = is_skinned(scene_, node, primitive);
  if (!deforms && (skinned || is_static(node))) return std::nullopt;
  const int singular = skinned ? 0 : count_singular(node);
  if (singular > resolution_) return std::nullopt;
  // Embree needs the inverse of an instance's matrix, so a node that is singular at times deforms instead.
  if (deforms || singular > 0) return deforming(node, primitive);
  if (!primitive.deformation) return rigid(node, primitive.mesh);
  return rigid(node, deformed_mesh(scene_, node, primitive, world(0), scene_.time));
}

Shutter::Moving Shutter::rigid(int node, std::shared_ptr<const Mesh> mesh) {
  const auto corners = corners_of(*mesh);
  float radius = 0;
  for (const int moment : {0, kSegments / 2, kSegments})
    radius = std::max(radius, radius_of(corners, world(moment, node)));
  const int segments = segments_for(kSegments, [&](int k, int before, int after) {
    const float fraction = fraction_of(k, before, after);
    const Mat4 off = world(before, node) * (1 - fraction) + world(after, node) * fraction - world(k, node);
    return std::ranges::all_of(
        corners, [&](const Vec3& c) { return glm::length(Vec3(off * Vec4(c, 1))) <= kTolerance * radius; });
  });
  auto motion = std::make_shared<Motion>();
  for (int k = 0; k <= segments; ++k) motion->to_world.push_back(world(k * (kSegments / segments), node));
  return {std::move(mesh), std::move(motion)};
}

std::shared_ptr<const Mesh> Shutter::mesh_at(int moment, int node, const Primitive& primitive) {
  if (!primitive.deformation) return in_world(primitive.mesh, world(moment, node));
  auto mesh = deformed_mesh(scene_, node, primitive, world(moment), time(moment));
  if (is_skinned(scene_, node, primitive)) return mesh;
  return in_world(std::move(mesh), world(moment, node));
}

std::optional<Shutter::Moving> Shutter::deforming(int node, const Primitive& primitive) {
  std::map<int, std::shared_ptr<const Mesh>> meshes;
  const auto positions = [&](int moment) -> const std::vector<Vec3>& {
    auto& mesh = meshes[moment];
    if (!mesh) mesh = mesh_at(moment, node, primitive);
    return mesh->positions;
  };
  float radius = 0;
  for (const int moment : {0, kSegments / 2, kSegments}) {
    Bounds bounds;
    for (const Vec3& p : positions(moment)) bounds.extend(p);
    radius = std::max(radius, bounds.radius());
  }
  const auto available = static_cast<unsigned>(kMaxVertices / std::max<size_t>(1, primitive.mesh->positions.size()));
  const int limit = std::min(kSegments, static_cast<int>(std::bit_floor(std::max(available, 1U))));
  const int segments = segments_for(limit, [&](int k, int before, int after) {
    return largest_deviation(positions(before), positions(after), fraction_of(k, before, after), positions(k)) <=
           kTolerance * radius;
  });
  if (segments == 1 && positions(0) == positions(kSegments)) return std::nullopt;
  auto motion = std::make_shared<Motion>();
  motion->mirrored = !is_skinned(scene_, node, primitive) && glm::determinant(Mat3(world(0, node))) < 0;
  for (int k = 0; k <= segments; ++k) {
    const int moment = k * (kSegments / segments);
    positions(moment);
    const Mesh& mesh = *meshes[moment];
    DeformedVertices& v = motion->vertices.emplace_back();
    v.positions.reserve(mesh.positions.size() + 1);
    v.positions.assign(mesh.positions.begin(), mesh.positions.end());
    v.normals = mesh.normals;
    v.tangents = mesh.tangents;
  }
  return Moving{meshes[0], std::move(motion)};
}

std::shared_ptr<const Motion> Shutter::motion_of(int node) {
  if (is_static(node)) return nullptr;
  auto motion = std::make_shared<Motion>();
  for (int k = 0; k <= kSegments; ++k) motion->to_world.push_back(world(k, node));
  return motion;
}

std::shared_ptr<const CameraMotion> Shutter::motion_of(const Camera& camera) {
  if (moving_.empty()) return nullptr;
  const int node = node_of_camera(scene_, camera);
  if (node < 0 || is_static(node)) return nullptr;
  std::vector<Mat4> matrices;
  for (int k = 0; k <= kSegments; ++k) matrices.push_back(camera_to_world(world(k, node)));
  return std::make_shared<CameraMotion>(matrices);
}

}  // namespace etendue::scene
