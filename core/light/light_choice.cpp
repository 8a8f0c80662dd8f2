// Choosing a light by the tree.
#include "light/light_table.h"

namespace etendue {
namespace {

// From this number of lights on the tree is worth its way down (docs/lights.md), where they stand apart: together they
// have less of an area than this part of the squared radius around them. The triangles of one lamp are all as near, and
// choosing them evenly keeps the strata of the random numbers whole.
constexpr size_t kMany = 8;
constexpr float kApart = 0.5f;
// However strong the sky is, what stands near by may be stronger, and the other way round.
constexpr float kLeastShare = 0.25f;

// Choices that are made by power all the same. What stands right behind a wall looks so strong to the tree that without
// them the light on this side would hardly ever be asked.
constexpr float kByPower = 1.0f / 64;

Vec3 unit_or_up(const Vec3& v) { return normalize_or(v, Vec3(0, 1, 0)); }

LightBounds bounds_at(const AreaLightTriangle& t) {
  LightBounds b;
  b.box.extend(t.p0), b.box.extend(t.p0 + t.e1), b.box.extend(t.p0 + t.e2);
  b.axis = unit_or_up(t.cross), b.normals = 0;
  b.two_sided = t.double_sided;
  b.intensity = t.area * luminance(t.radiance);
  return b;
}

LightBounds bounds_at(const AreaLightTriangle& t, const RoundShape& shape) {
  LightBounds b;
  Vec3 half(shape.radius);
  b.intensity = t.area * luminance(t.radiance);
  if (shape.kind == RoundShape::Kind::disk) {
    half = shape.radius * glm::sqrt(glm::max(Vec3(0), 1.0f - shape.frame.z * shape.frame.z));
    b.axis = shape.frame.z, b.normals = 0, b.two_sided = t.double_sided;
  } else {
    b.intensity /= 4;  // what is seen of it
  }
  b.box.extend(shape.centre - half), b.box.extend(shape.centre + half);
  return b;
}

LightBounds bounds_at(const Light& light, const LightPlace& place) {
  LightBounds b;
  b.box.extend(place.position);
  b.intensity = light.intensity * luminance(light.color);
  b.range = light.range;
  if (light.type == LightType::spot) b.axis = place.direction, b.normals = 0, b.emission = light.outer_cone;
  return b;
}

// What moves on straight lines is always within the box around its places at their ends. It may turn meanwhile.
template <class At>
LightBounds bounds_over_time(const Motion& motion, At&& at) {
  LightBounds all = at(0.0f);
  const auto intervals = static_cast<float>(motion.steps() - 1);
  for (size_t k = 1; k < motion.steps(); ++k) {
    const LightBounds b = at(static_cast<float>(k) / intervals);
    if (b.axis != all.axis) all.normals = kPi;
    all.box.extend(b.box), all.intensity = std::max(all.intensity, b.intensity);
  }
  return all;
}

}  // namespace

bool LightTable::is_infinite(uint32_t light) const {
  if (light < triangles_.size()) return false;
  const size_t placed = light - triangles_.size();
  return placed >= placed_.size() || placed_[placed].light.type == LightType::directional ||
         placed_[placed].light.type == LightType::ambient;
}

LightBounds LightTable::bounds_of(uint32_t light) const {
  if (light < triangles_.size()) {
    const AreaLightTriangle& t = triangles_[light];
    if (t.round >= 0) {
      const RoundLight& round = round_of(t);
      const auto at = [&](float time) { return bounds_at(t, round.at(time)); };
      return round.motion ? bounds_over_time(*round.motion, at) : at(0);
    }
    if (!t.moving) return bounds_at(t);
    return bounds_over_time(*movers_[t.instance].motion, [&](float time) { return bounds_at(moved(t, time)); });
  }
  const PlacedLight& placed = placed_[light - triangles_.size()];
  if (!placed.motion) return bounds_at(placed.light, placed.place);
  return bounds_over_time(*placed.motion, [&](float time) { return bounds_at(placed.light, placed.at(time)); });
}

void LightTable::plant_tree(std::span<const float> powers) {
  std::vector<LightBounds> local(powers.size());
  std::vector<float> far;
  float all = 0, area = 0;
  Bounds around;
  for (uint32_t light = 0; light < powers.size(); ++light) {
    all += powers[light];
    if (is_infinite(light)) {
      infinite_.push_back(light), far.push_back(powers[light]);
    } else if (powers[light] > 0) {
      local[light] = bounds_of(light);
      around.extend(local[light].box);
      if (light < triangles_.size()) area += triangles_[light].area;
    }
  }
  tree_ = LightTree(local);
  many_ = powers.size() - infinite_.size() >= kMany && area < kApart * sqr(around.radius());
  float from_far = 0;
  for (const float power : far) from_far += power;
  if (!(from_far > 0)) return;
  infinite_choice_ = AliasTable(far);
  infinite_share_ = tree_.empty() ? 1 : std::clamp(from_far / all, kLeastShare, 1 - kLeastShare);
}

AliasTable::Choice LightTable::choose_by_tree(const Vec3& from, float u) const {
  if (u < kByPower) {
    const auto choice = choice_.sample(u / kByPower);
    return {choice.index, choice.probability > 0 ? probability_by_tree(choice.index, from) : 0};
  }
  u = std::min((u - kByPower) / (1 - kByPower), kOneMinusEpsilon);
  const auto with_the_rest = [&](uint32_t light, float probability) {
    return AliasTable::Choice{light, (1 - kByPower) * probability + kByPower * choice_.probability(light)};
  };
  if (u < infinite_share_) {
    const auto choice = infinite_choice_.sample(u / infinite_share_);
    return with_the_rest(infinite_[choice.index], choice.probability * infinite_share_);
  }
  const float local = 1 - infinite_share_;
  const auto choice = tree_.choose(from, std::min((u - infinite_share_) / local, kOneMinusEpsilon));
  return choice.probability > 0 ? with_the_rest(choice.index, choice.probability * local) : choice;
}

float LightTable::probability_by_tree(uint32_t light, const Vec3& from) const {
  const float p = is_infinite(light) ? infinite_share_ * probability_of_infinite(light)
                                     : (1 - infinite_share_) * tree_.probability(light, from);
  return (1 - kByPower) * p + kByPower * choice_.probability(light);
}

float LightTable::probability_of_infinite(uint32_t light) const {
  if (infinite_choice_.empty()) return 0;
  const auto at = std::lower_bound(infinite_.begin(), infinite_.end(), light) - infinite_.begin();
  return infinite_choice_.probability(static_cast<uint32_t>(at));
}

}  // namespace etendue
