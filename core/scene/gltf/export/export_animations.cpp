// Exports skins and animations.
#include "scene/gltf/export/output_file.h"

namespace etendue::scene::gltf {
namespace {

class AnimationExporter {
 public:
  explicit AnimationExporter(OutputFile& out) : out_(out) {}

  Json run(const Animation& animation) {
    Json to{{"channels", Json::array()}, {"samplers", Json::array()}};
    put_name(to, animation.name);
    for (const AnimationChannel& channel : animation.channels) {
      to["channels"].push_back({{"sampler", to["samplers"].size()},
                                {"target", {{"node", channel.node}, {"path", kPaths[index(channel.path)]}}}});
      Json sampler{{"input", times(channel.times)}, {"output", values(channel)}};
      if (channel.interpolation != Interpolation::linear)
        sampler["interpolation"] = channel.interpolation == Interpolation::step ? "STEP" : "CUBICSPLINE";
      to["samplers"].push_back(std::move(sampler));
    }
    return to;
  }

 private:
  static constexpr const char* kPaths[] = {"translation", "rotation", "scale", "weights"};
  template <class E>
  static size_t index(E e) {
    return static_cast<size_t>(e);
  }

  // Channels with equal times share an accessor.
  int times(const std::vector<float>& keys) {
    const auto [entry, added] = times_.try_emplace(keys, 0);
    if (!added) return entry->second;
    entry->second = out_.floats(keys);
    Json& accessor = out_.root["accessors"].back();
    accessor["min"] = Json::array({number(keys.front())});
    accessor["max"] = Json::array({number(keys.back())});
    return entry->second;
  }

  int values(const AnimationChannel& channel) {
    if (channel.path == AnimatedPath::weights) return out_.floats(channel.values);
    const bool rotation = channel.path == AnimatedPath::rotation;
    return out_.accessor(std::as_bytes(std::span(channel.values)), TINYGLTF_COMPONENT_TYPE_FLOAT,
                         rotation ? "VEC4" : "VEC3", channel.values.size() / channel.components);
  }

  OutputFile& out_;
  std::map<std::vector<float>, int> times_;
};

}  // namespace

void export_skins(OutputFile& out) {
  for (const auto& skin : out.scene.skins)
    out.add("skins",
            {{"joints", skin->joints},
             {"inverseBindMatrices", out.accessor(skin->inverse_bind, TINYGLTF_COMPONENT_TYPE_FLOAT, "MAT4")}});
}

void export_animations(OutputFile& out) {
  AnimationExporter writer(out);
  for (const auto& animation : out.scene.animations)
    if (!animation->channels.empty()) out.add("animations", writer.run(*animation));
}

}  // namespace etendue::scene::gltf
