#include "radiosity/hierarchy.h"

#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "base/warp.h"
#include "radiosity/patch_rays.h"

namespace etendue::radiosity {
namespace {

constexpr double kLeastFactor = 1e-9;  // smaller form factors are zero up to rounding

// Point s of a rank-1 lattice of four dimensions, moved by a random vector.
Vec4 lattice_point(uint32_t seed, int s) {
  const Vec4 shift(static_cast<float>(seed & 255) / 256, static_cast<float>(seed >> 8 & 255) / 256,
                   static_cast<float>(seed >> 16 & 255) / 256, static_cast<float>(seed >> 24) / 256);
  const Vec4 step(0.8566748838545029f, 0.733891856627126f, 0.6287067210378087f, 0.5385972572236101f);
  return glm::fract(shift + static_cast<float>(s) * step);
}

}  // namespace

// The state of the search for the links of one root.
struct Hierarchy::LinkSearch {
  const scene::CompiledScene& scene;
  std::vector<FoundLink>& found;
  const KeepGoing* keep_going;
  uint64_t rays = 0;
  uint32_t steps = 0;
};

Hierarchy::Hierarchy(const PatchMesh& mesh, const HierarchySettings& settings) : mesh_(mesh), settings_(settings) {
  const auto& patches = mesh.patches();
  for (size_t first = 0; first < patches.size();) {
    const Patch& patch = patches[first];
    size_t last = first;
    while (last < patches.size() && patches[last].instance == patch.instance &&
           patches[last].triangle == patch.triangle)
      ++last;
    const auto steps = static_cast<uint32_t>(std::lround(std::sqrt(static_cast<double>(last - first))));
    for (const bool front : {true, false}) {
      roots_.push_back(static_cast<uint32_t>(nodes_.size()));
      // The corners of the triangle from its first patch, which lies at vertex 0.
      const Vec3 e1 = (patch.p1 - patch.p0) * static_cast<float>(steps),
                 e2 = (patch.p2 - patch.p0) * static_cast<float>(steps);
      nodes_.push_back({patch.p0, patch.p0 + e1, patch.p0 + e2, patch.area * sqr(static_cast<float>(steps)), kNoElement,
                        kNoElement, kNoElement});
      divide(mesh, roots_.back(), steps, patch.instance, patch.triangle, front, {Vec2(0), Vec2(1, 0), Vec2(0, 1)});
    }
    first = last;
  }
  found_.resize(roots_.size());
  closed_.resize(mesh.element_count());
}

void Hierarchy::divide(const PatchMesh& mesh, uint32_t node, uint32_t steps, uint32_t instance, uint32_t triangle,
                       bool front, const std::array<Vec2, 3>& b) {
  if (steps == 1) {
    const Vec2 centre = (b[0] + b[1] + b[2]) / 3.0f;
    nodes_[node].element = mesh.locate(instance, triangle, centre.x, centre.y, front).element;
    return;
  }
  const Node parent = nodes_[node];
  const auto first = static_cast<uint32_t>(nodes_.size());
  nodes_[node].first_child = first;
  const Vec3 m01 = (parent.p0 + parent.p1) / 2.0f, m12 = (parent.p1 + parent.p2) / 2.0f,
             m20 = (parent.p2 + parent.p0) / 2.0f;
  const Vec2 b01 = (b[0] + b[1]) / 2.0f, b12 = (b[1] + b[2]) / 2.0f, b20 = (b[2] + b[0]) / 2.0f;
  const std::array<std::array<Vec3, 3>, 4> corners{
      {{parent.p0, m01, m20}, {m01, parent.p1, m12}, {m20, m12, parent.p2}, {m12, m20, m01}}};
  const std::array<std::array<Vec2, 3>, 4> parts{
      {{b[0], b01, b20}, {b01, b[1], b12}, {b20, b12, b[2]}, {b12, b20, b01}}};
  for (const auto& c : corners) nodes_.push_back({c[0], c[1], c[2], parent.area / 4, node, kNoElement, kNoElement});
  for (uint32_t k = 0; k < 4; ++k) divide(mesh, first + k, steps / 2, instance, triangle, front, parts[k]);
  nodes_[node].element = nodes_[first].element;
}

std::optional<uint64_t> Hierarchy::run(const scene::CompiledScene& scene, int task, const KeepGoing* keep_going) {
  const auto first = static_cast<size_t>(task);
  found_[first].clear();
  LinkSearch search{scene, found_[first], keep_going};
  for (size_t other = first + 1; other < roots_.size(); ++other)
    if (!refine(search, roots_[first], roots_[other])) return {};
  found_[first].shrink_to_fit();
  find_closed(search, roots_[first]);
  return search.rays;
}

// Casts cosine-distributed rays from the elements below a node.
void Hierarchy::find_closed(LinkSearch& search, uint32_t node) {
  const Node& n = nodes_[node];
  if (n.first_child != kNoElement) {
    for (uint32_t k = 0; k < 4; ++k) find_closed(search, n.first_child + k);
    return;
  }
  const uint32_t seed = element_seed(settings_.seed + 1, node);
  const Frame frame(normal_of(node));
  HitRays rays(search.scene, mesh_, seed);
  int hits = 0;
  const auto count = [&](uint32_t, float) { ++hits; };
  for (int s = 0; s < settings_.closure_rays; ++s) {
    const Vec4 u = lattice_point(seed, s);
    const Vec3 point = point_of(n, {u.x, u.y});
    rays.add(off_surface(mesh_, n.element, point), frame.to_world(square_to_cosine_hemisphere({u.z, u.w})), 1, count);
  }
  rays.trace(count);
  search.rays += rays.traced();
  closed_[n.element] = hits == settings_.closure_rays ? 1 : 0;
}

// Whether some corner of q lies in front of p, by more than the rounding error.
bool Hierarchy::sees(uint32_t p, uint32_t q) const {
  const Node &a = nodes_[p], &b = nodes_[q];
  const Vec3 normal = normal_of(p);
  const float margin = mesh_.patch_of(a.element).offset + mesh_.patch_of(b.element).offset;
  return glm::dot(b.p0 - a.p0, normal) > margin || glm::dot(b.p1 - a.p0, normal) > margin ||
         glm::dot(b.p2 - a.p0, normal) > margin;
}

// False if it was stopped.
bool Hierarchy::refine(LinkSearch& search, uint32_t p, uint32_t q) const {
  if (++search.steps % 256 == 0 && stops(search.keep_going)) return false;
  if (!sees(p, q) || !sees(q, p)) return true;
  const Node &a = nodes_[p], &b = nodes_[q];
  const auto factor = [&](uint32_t from, uint32_t to) {
    const Node& n = nodes_[from];
    return point_to_polygon(DVec3((n.p0 + n.p1 + n.p2) / 3.0f), DVec3(normal_of(from)), polygon_of_node(to));
  };
  const double to_q = factor(p, q), to_p = factor(q, p), most = std::max(to_q, to_p);
  const bool divisible = a.first_child != kNoElement || b.first_child != kNoElement;
  // The centroid of a divisible node may lie behind the other one although a part of it lies in front.
  const bool is_crossed = divisible && std::min(to_q, to_p) < kLeastFactor;
  double visible = 1;
  bool divides = divisible && (most > settings_.error || is_crossed);
  if (!divides) {
    visible = visibility(search, p, q);
    divides = divisible && visible > 0 && visible < 1 && most > settings_.partly_visible * settings_.error;
  }
  if (!divides) {
    if (!(visible > 0)) return true;
    const double value = visible * exchange(p, q, to_q, to_p);
    if (value > 0) search.found.push_back({p, q, static_cast<float>(value)});
    return true;
  }
  // The node that appears larger is divided.
  const bool divides_q = b.first_child != kNoElement && (to_q >= to_p || a.first_child == kNoElement);
  for (uint32_t k = 0; k < 4; ++k)
    if (!(divides_q ? refine(search, p, b.first_child + k) : refine(search, a.first_child + k, q))) return false;
  return true;
}

Polygon Hierarchy::polygon_of_node(uint32_t node) const {
  const Node& n = nodes_[node];
  const bool ordered = glm::dot(glm::cross(n.p1 - n.p0, n.p2 - n.p0), normal_of(node)) > 0;
  return ordered ? Polygon{n.p0, n.p1, n.p2} : Polygon{n.p0, n.p2, n.p1};
}

// The area times the form factor of two unoccluded nodes, whose factors from their centroids are given. Close leaves, for
// which centroids do not stand for the whole, have the exact value.
double Hierarchy::exchange(uint32_t p, uint32_t q, double to_q, double to_p) const {
  const Node &a = nodes_[p], &b = nodes_[q];
  if (std::max(to_q, to_p) <= settings_.error)
    return 0.5 * (static_cast<double>(a.area) * to_q + static_cast<double>(b.area) * to_p);
  const Polygon seen = clipped(polygon_of_node(q), DVec3(a.p0), DVec3(normal_of(p)));
  const Polygon seeing = clipped(polygon_of_node(p), DVec3(b.p0), DVec3(normal_of(q)));
  return seen.empty() || seeing.empty() ? 0 : contour_exchange(seeing, seen, 8);
}

// The fraction of segments between points of both nodes that are not occluded.
double Hierarchy::visibility(LinkSearch& search, uint32_t p, uint32_t q) const {
  const Node &a = nodes_[p], &b = nodes_[q];
  const uint32_t seed = hash_combine(element_seed(settings_.seed, p), q);
  VisibilityRays rays(search.scene, seed);
  double visible = 0;
  int tested = 0;
  const auto count = [&](double weight) { visible += weight; };
  for (int s = 0; s < settings_.rays; ++s) {
    const Vec4 u = lattice_point(seed, s);
    const Vec3 from = point_of(a, {u.x, u.y}), to = point_of(b, {u.z, u.w});
    const Vec3 d = to - from;
    if (!(glm::dot(d, normal_of(p)) > 0) || !(glm::dot(d, normal_of(q)) < 0)) continue;
    ++tested;
    rays.add(from + normal_of(p) * mesh_.patch_of(a.element).offset,
             to + normal_of(q) * mesh_.patch_of(b.element).offset, 1, count);
  }
  rays.trace(count);
  search.rays += rays.traced();
  return tested > 0 ? visible / tested : 0;
}

void Hierarchy::finish() {
  starts_.assign(nodes_.size() + 1, 0);
  for (const auto& list : found_)
    for (const FoundLink& l : list) {
      ++starts_[l.from + 1];
      ++starts_[l.to + 1];
      ++link_count_;
    }
  for (size_t i = 0; i < nodes_.size(); ++i) starts_[i + 1] += starts_[i];
  links_.resize(starts_.back());
  std::vector<size_t> next(starts_.begin(), starts_.end() - 1);
  for (auto& list : found_) {
    for (const FoundLink& l : list) {
      links_[next[l.from]++] = {l.to, l.exchange};
      links_[next[l.to]++] = {l.from, l.exchange};
    }
    list = {};
  }
  found_ = {};
  closures_.clear();
  for (const Rgb& sum : gather_unscaled(std::vector<Rgb>(mesh_.element_count(), Rgb(1))))
    closures_.push_back(static_cast<double>(sum.r));
}

std::vector<Rgb> Hierarchy::gather(const std::vector<Rgb>& radiosity) const {
  std::vector<Rgb> irradiance = gather_unscaled(radiosity);
  for (size_t e = 0; e < irradiance.size(); ++e)
    if (closures_[e] > 1 || (closed_[e] && closures_[e] > 0)) irradiance[e] /= static_cast<float>(closures_[e]);
  return irradiance;
}

std::vector<Rgb> Hierarchy::gather_unscaled(const std::vector<Rgb>& radiosity) const {
  std::vector<Rgb> node_radiosity(nodes_.size()), irradiance(nodes_.size()), by_element(radiosity.size());
  // Children follow their parents.
  for (size_t i = nodes_.size(); i-- > 0;) {
    const Node& n = nodes_[i];
    if (n.first_child == kNoElement) {
      node_radiosity[i] = radiosity[n.element];
    } else {
      Rgb sum(0);
      for (size_t k = 0; k < 4; ++k) sum += node_radiosity[n.first_child + k];
      node_radiosity[i] = sum / 4.0f;
    }
  }
  for (size_t i = 0; i < nodes_.size(); ++i) {
    Rgb sum(0);
    for (size_t l = starts_[i]; l < starts_[i + 1]; ++l) sum += node_radiosity[links_[l].to] * links_[l].exchange;
    const Node& n = nodes_[i];
    irradiance[i] = sum / n.area + (n.parent == kNoElement ? Rgb(0) : irradiance[n.parent]);
    if (n.first_child == kNoElement) by_element[n.element] = irradiance[i];
  }
  return by_element;
}

size_t Hierarchy::memory() const {
  size_t bytes = nodes_.capacity() * sizeof(Node) + roots_.capacity() * sizeof(uint32_t) +
                 starts_.capacity() * sizeof(size_t) + links_.capacity() * sizeof(Link) + closed_.capacity() +
                 closures_.capacity() * sizeof(double);
  for (const auto& list : found_) bytes += list.capacity() * sizeof(FoundLink);
  return bytes;
}

IrradianceField solve_hierarchically(const Hierarchy& hierarchy, const std::vector<Rgb>& reflectance,
                                     const std::vector<Rgb>& direct, const SolverSettings& settings) {
  const size_t n = direct.size();
  IrradianceField field;
  field.total = field.gathered = direct;
  field.indirect.resize(n);
  field.unshot.resize(n);
  std::vector<Rgb> radiosity(n);
  float largest = 0, change = 0;
  const auto reflect = [&] {
    largest = change = 0;
    for (size_t i = 0; i < n; ++i) {
      const Rgb next = reflectance[i / 2] * field.total[i];
      field.unshot[i] = next - radiosity[i];
      for (int c = 0; c < 3; ++c) change = std::max(change, std::abs(field.unshot[i][c]));
      largest = std::max(largest, max_component(next));
      radiosity[i] = next;
    }
  };
  double q = 0;
  for (size_t i = 0; i < n; ++i)
    if (hierarchy.closures()[i] > 0) q = std::max(q, static_cast<double>(max_component(reflectance[i / 2])));
  reflect();
  while (field.sweeps < settings.max_sweeps) {
    ++field.sweeps;
    field.indirect = hierarchy.gather(radiosity);
    for (size_t i = 0; i < n; ++i) field.total[i] = direct[i] + field.indirect[i];
    reflect();
    field.error_bound = q < 1 && largest > 0 ? static_cast<double>(change / largest) * q / (1 - q) : 0;
    if (q >= 1 || field.error_bound <= settings.tolerance) break;
  }
  field.gathered = field.total;
  if (q >= 1) {
    field.has_diverged = true;
    field.error_bound = HUGE_VAL;
    field.problem = "a patch reflects all light that it receives, or more: lower reflectances below 1";
    field.total = field.gathered = direct;
    field.indirect.assign(n, Rgb(0));
  } else if (field.error_bound > settings.tolerance) {
    field.problem = "the tolerance was not reached: allow more sweeps or a larger tolerance";
  }
  return field;
}

}  // namespace etendue::radiosity
