// Imports skins and animations.                                                glTF 2.0, sections 3.7.3 and 3.11
#include <map>
#include <set>

#include "scene/coordinate_range.h"
#include "scene/gltf/import/accessor.h"
#include "scene/gltf/import/importers.h"
#include "scene/pose.h"

namespace etendue::scene::gltf {
namespace {

// The number of morph targets of the node's mesh; 0 without a mesh.
size_t morph_targets(const InputFile& input, int node) {
  const int mesh = input.model.nodes[static_cast<size_t>(node)].mesh;
  size_t targets = 0;
  if (mesh >= 0)
    for (const auto& primitive : input.model.meshes[static_cast<size_t>(mesh)].primitives)
      targets = std::max(targets, primitive.targets.size());
  return targets;
}

class AnimationImporter {
 public:
  AnimationImporter(const InputFile& input, const tinygltf::Animation& from, std::string where,
                    std::vector<std::string>& warnings)
      : input_(input), from_(from), where_(std::move(where)), warnings_(warnings) {}

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
  // Reads one channel. Returns why it cannot be played; empty if it can.
  std::string read(const tinygltf::AnimationChannel& from, AnimationChannel& channel) {
    static const std::map<std::string, AnimatedPath> kPaths{{"translation", AnimatedPath::translation},
                                                            {"rotation", AnimatedPath::rotation},
                                                            {"scale", AnimatedPath::scale},
                                                            {"weights", AnimatedPath::weights}};
    const auto path = kPaths.find(from.target_path);
    if (path == kPaths.end()) return "cannot animate '" + from.target_path.substr(0, 40) + "'";
    if (from.target_node < 0) return "has no target node";
    channel.node = from.target_node;
    channel.path = path->second;
    if (!targets_.insert({channel.node, channel.path}).second)
      return "an earlier channel animates the same " + from.target_path;
    if (const std::string problem = target_problem(channel); !problem.empty()) return problem;
    const auto& sampler = from_.samplers[static_cast<size_t>(from.sampler)];
    if (sampler.interpolation == "STEP")
      channel.interpolation = Interpolation::step;
    else if (sampler.interpolation == "CUBICSPLINE")
      channel.interpolation = Interpolation::cubic;
    else if (sampler.interpolation != "LINEAR")
      return "the interpolation has to be LINEAR, STEP or CUBICSPLINE";
    const std::string at_sampler = where_ + "." + at("samplers", static_cast<size_t>(from.sampler));
    const AccessorUse use = channel.path == AnimatedPath::rotation  ? AccessorUse::rotations
                            : channel.path == AnimatedPath::weights ? AccessorUse::morph_weights
                                                                    : AccessorUse::vectors;
    channel.times = read_floats(input_, sampler.input, AccessorUse::times, at_sampler + ".input");
    channel.values = read_floats(input_, sampler.output, use, at_sampler + ".output");
    return keyframe_problem(channel);
  }

  std::string target_problem(AnimationChannel& channel) const {
    const auto& node = input_.model.nodes[static_cast<size_t>(channel.node)];
    if (channel.path == AnimatedPath::weights) {
      channel.components = morph_targets(input_, channel.node);
      return channel.components > 0 ? "" : "the target node has no morph targets";
    }
    channel.components = channel.path == AnimatedPath::rotation ? 4 : 3;
    return node.matrix.empty() ? ""
                               : "the target node has a matrix; animated nodes need translation, rotation and scale";
  }

  static std::string keyframe_problem(AnimationChannel& channel) {
    const auto& times = channel.times;
    if (times.empty()) return "has no keyframes";
    for (size_t i = 0; i < times.size(); ++i)
      if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1])))
        return "the times do not increase strictly (keyframe " + std::to_string(i) + ")";
    const bool cubic = channel.interpolation == Interpolation::cubic;
    const size_t needed = times.size() * channel.components * (cubic ? 3 : 1);
    if (channel.values.size() != needed)
      return "has " + std::to_string(channel.values.size()) + " values, but its " + std::to_string(times.size()) +
             " keyframes need " + std::to_string(needed);
    for (const float v : channel.values)
      if (!(std::abs(v) <= kMaxCoordinate)) return "has values that are not finite or beyond 1e9";
    if (channel.path == AnimatedPath::rotation) normalise_keys(channel, cubic);
    return "";
  }

  // Normalises rotations. Tangents are not rotations and stay unchanged.
  static void normalise_keys(AnimationChannel& channel, bool cubic) {
    for (size_t k = 0; k < channel.times.size(); ++k) {
      float* q = &channel.values[(cubic ? 3 * k + 1 : k) * 4];
      const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      // Within rounding of unit length, the value of the file is kept bit for bit.
      constexpr float kRounding = 1e-6f;
      if (std::abs(length - 1) <= kRounding) continue;
      for (size_t c = 0; c < 4; ++c) q[c] = length > 0 ? q[c] / length : (c == 3 ? 1.0f : 0.0f);
    }
  }

  const InputFile& input_;
  const tinygltf::Animation& from_;
  std::string where_;
  std::vector<std::string>& warnings_;
  std::set<std::pair<int, AnimatedPath>> targets_;
};

}  // namespace

void import_skins(const InputFile& input, Scene& scene) {
  for (size_t s = 0; s < input.model.skins.size(); ++s) {
    const auto& from = input.model.skins[s];
    const std::string where = at("skins", s);
    auto skin = std::make_shared<Skin>();
    skin->joints = from.joints;
    if (from.inverseBindMatrices >= 0)
      skin->inverse_bind = read_matrices(input, from.inverseBindMatrices, where + ".inverseBindMatrices");
    skin->inverse_bind.resize(skin->joints.size(), Mat4(1));
    size_t invalid = 0;
    for (Mat4& m : skin->inverse_bind) {
      if (is_within_range(m)) continue;
      m = Mat4(1);
      ++invalid;
    }
    if (invalid > 0)
      scene.warnings.push_back(
          where + ".inverseBindMatrices: " + std::to_string(invalid) +
          " matrices with elements that are not finite or beyond 1e9 were replaced by the identity");
    scene.skins.push_back(std::move(skin));
  }
}

void import_animations(const InputFile& input, Scene& scene) {
  for (size_t a = 0; a < input.model.animations.size(); ++a)
    scene.animations.push_back(
        AnimationImporter(input, input.model.animations[a], at("animations", a), scene.warnings).run());
  if (const size_t playing = playing_animations(scene).size(); playing < scene.animations.size())
    scene.warnings.push_back(std::to_string(scene.animations.size() - playing) +
                             " animations move the same nodes as an earlier one; only the earlier one plays");
}

}  // namespace etendue::scene::gltf
