// Skins and animations.                                                        glTF 2.0, sections 3.7.3 and 3.11
#include <map>
#include <set>

#include "scene/gltf/accessor.h"
#include "scene/gltf/import.h"
#include "scene/pose.h"

namespace etendue::scene::gltf {
namespace {

bool finite(const Mat4& m) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(m[c][r])) return false;
  return true;
}

// The targets of the node's mesh; its primitives have to agree.
size_t morph_targets(const Document& document, int node) {
  const int mesh = document.model.nodes[static_cast<size_t>(node)].mesh;
  size_t targets = 0;
  if (mesh >= 0)
    for (const auto& primitive : document.model.meshes[static_cast<size_t>(mesh)].primitives)
      targets = std::max(targets, primitive.targets.size());
  return targets;
}

class AnimationImporter {
 public:
  AnimationImporter(const Document& document, const tinygltf::Animation& from, std::string where,
                    std::vector<std::string>& warnings)
      : document_(document), from_(from), where_(std::move(where)), warnings_(warnings) {}

  std::shared_ptr<const Animation> run() {
    auto animation = std::make_shared<Animation>();
    animation->name = from_.name;
    for (size_t c = 0; c < from_.channels.size(); ++c) {
      AnimationChannel channel;
      const std::string problem = read(from_.channels[c], channel);
      if (!problem.empty()) {
        warnings_.push_back(where_ + "." + at("channels", c) + ": " + problem + "; it is ignored");
        continue;
      }
      animation->duration = std::max(animation->duration, channel.times.back());
      animation->channels.push_back(std::move(channel));
    }
    return animation;
  }

 private:
  // Why the channel cannot be played; empty if it can.
  std::string read(const tinygltf::AnimationChannel& from, AnimationChannel& channel) {
    static const std::map<std::string, AnimatedPath> kPaths{{"translation", AnimatedPath::translation},
                                                            {"rotation", AnimatedPath::rotation},
                                                            {"scale", AnimatedPath::scale},
                                                            {"weights", AnimatedPath::weights}};
    const auto path = kPaths.find(from.target_path);
    if (path == kPaths.end()) return "cannot animate '" + from.target_path.substr(0, 40) + "'";
    if (from.target_node < 0) return "names no node";
    channel.node = from.target_node, channel.path = path->second;
    if (!targets_.insert({channel.node, channel.path}).second)
      return "an earlier channel animates the same " + from.target_path;
    if (const std::string problem = target_problem(channel); !problem.empty()) return problem;
    const auto& sampler = from_.samplers[static_cast<size_t>(from.sampler)];
    if (sampler.interpolation == "STEP")
      channel.interpolation = Interpolation::step;
    else if (sampler.interpolation == "CUBICSPLINE")
      channel.interpolation = Interpolation::cubic;
    else if (sampler.interpolation != "LINEAR")
      return "its interpolation is none of LINEAR, STEP and CUBICSPLINE";
    const std::string at_sampler = where_ + "." + at("samplers", static_cast<size_t>(from.sampler));
    const Use use = channel.path == AnimatedPath::rotation  ? Use::rotations
                    : channel.path == AnimatedPath::weights ? Use::morph_weights
                                                            : Use::vectors;
    channel.times = read_floats(document_, sampler.input, Use::times, at_sampler + ".input");
    channel.values = read_floats(document_, sampler.output, use, at_sampler + ".output");
    return numbers_problem(channel);
  }

  std::string target_problem(AnimationChannel& channel) const {
    const auto& node = document_.model.nodes[static_cast<size_t>(channel.node)];
    if (channel.path == AnimatedPath::weights) {
      channel.components = morph_targets(document_, channel.node);
      return channel.components > 0 ? "" : "its node has no morph targets";
    }
    channel.components = channel.path == AnimatedPath::rotation ? 4 : 3;
    return node.matrix.empty() ? "" : "its node has a matrix instead of translation, rotation and scale";
  }

  static std::string numbers_problem(AnimationChannel& channel) {
    const auto& times = channel.times;
    if (times.empty()) return "has no keys";
    for (size_t i = 0; i < times.size(); ++i)
      if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
        return "its times do not grow from key to key (key " + std::to_string(i) + ")";
    const bool cubic = channel.interpolation == Interpolation::cubic;
    const size_t needed = times.size() * channel.components * (cubic ? 3 : 1);
    if (channel.values.size() != needed)
      return "has " + std::to_string(channel.values.size()) + " values where its " + std::to_string(times.size()) +
             " keys need " + std::to_string(needed);
    for (const float v : channel.values)
      if (!std::isfinite(v)) return "has values that are no finite numbers";
    if (channel.path == AnimatedPath::rotation) normalise_keys(channel, cubic);
    return "";
  }

  // Tangents are no rotations and stay as they are.
  static void normalise_keys(AnimationChannel& channel, bool cubic) {
    for (size_t k = 0; k < channel.times.size(); ++k) {
      float* q = &channel.values[(cubic ? 3 * k + 1 : k) * 4];
      const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      // What rounding alone keeps from being a unit stays as the file has it.
      constexpr float kNearlyOne = 1e-6f;
      if (std::abs(length - 1) <= kNearlyOne) continue;
      for (size_t c = 0; c < 4; ++c) q[c] = length > 0 ? q[c] / length : (c == 3 ? 1.0f : 0.0f);
    }
  }

  const Document& document_;
  const tinygltf::Animation& from_;
  std::string where_;
  std::vector<std::string>& warnings_;
  std::set<std::pair<int, AnimatedPath>> targets_;
};

}  // namespace

void import_skins(const Document& document, Scene& scene) {
  for (size_t s = 0; s < document.model.skins.size(); ++s) {
    const auto& from = document.model.skins[s];
    const std::string where = at("skins", s);
    auto skin = std::make_shared<Skin>();
    skin->joints = from.joints;
    if (from.inverseBindMatrices >= 0)
      skin->inverse_bind = read_matrices(document, from.inverseBindMatrices, where + ".inverseBindMatrices");
    skin->inverse_bind.resize(skin->joints.size(), Mat4(1));
    size_t wrong = 0;
    for (Mat4& m : skin->inverse_bind)
      if (!finite(m)) m = Mat4(1), ++wrong;
    if (wrong > 0)
      scene.warnings.push_back(where + ".inverseBindMatrices: " + std::to_string(wrong) +
                               " matrices with numbers that are not finite became the identity");
    scene.skins.push_back(std::move(skin));
  }
}

void import_animations(const Document& document, Scene& scene) {
  for (size_t a = 0; a < document.model.animations.size(); ++a)
    scene.animations.push_back(
        AnimationImporter(document, document.model.animations[a], at("animations", a), scene.warnings).run());
  if (const size_t playing = playing_animations(scene).size(); playing < scene.animations.size())
    scene.warnings.push_back(std::to_string(scene.animations.size() - playing) +
                             " animations move what an earlier one moves already; they do not play");
}

}  // namespace etendue::scene::gltf
