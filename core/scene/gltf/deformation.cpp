// Morph targets, and the joints that vertices hang on.                                glTF 2.0, sections 3.7.2.2, 3.7.3
#include "scene/gltf/accessor.h"
#include "scene/gltf/import.h"

namespace etendue::scene::gltf {
namespace {

template <class T>
std::vector<T> chosen(const std::vector<T>& values, const std::vector<uint32_t>& sources, size_t old_vertices) {
  std::vector<T> result;
  result.reserve(values.size() / std::max<size_t>(old_vertices, 1) * sources.size());
  for (size_t first = 0; first + old_vertices <= values.size() && old_vertices > 0; first += old_vertices)
    for (const uint32_t v : sources) result.push_back(values[first + v]);
  return result;
}

class DeformationReader {
 public:
  DeformationReader(const Document& document, const MeshTask& task, const std::vector<uint32_t>& selection,
                    size_t vertices, std::vector<std::string>& warnings)
      : document_(document),
        task_(task),
        selection_(selection.empty() ? nullptr : &selection),
        vertices_(vertices),
        warnings_(warnings) {}

  std::shared_ptr<Deformation> run() {
    auto deformation = std::make_shared<Deformation>();
    for (size_t t = 0; t < task_.primitive->targets.size(); ++t) deformation->targets.push_back(read_target(t));
    read_joints_and_weights(*deformation);
    if (deformation->joint_sets > 0) normalise(*deformation);
    return deformation->targets.empty() && deformation->joint_sets == 0 ? nullptr : deformation;
  }

 private:
  MorphTarget read_target(size_t index) {
    MorphTarget target;
    const std::pair<const char*, std::vector<Vec3>*> parts[] = {
        {"POSITION", &target.positions}, {"NORMAL", &target.normals}, {"TANGENT", &target.tangents}};
    for (const auto& [name, values] : parts) {
      const auto found = task_.primitive->targets[index].find(name);
      if (found == task_.primitive->targets[index].end()) continue;
      const std::string where = task_.where + "." + at("targets", index) + "." + name;
      const bool place = values == &target.positions;
      *values =
          read_vec3(document_, found->second, place ? Use::morph_position : Use::morph_direction, selection_, where);
      size_t wrong = 0;
      for (Vec3& v : *values)
        if (!is_finite(v)) v = Vec3(0), ++wrong;
      if (wrong > 0)
        warnings_.push_back(where + ": " + std::to_string(wrong) +
                            " displacements that are no finite numbers became 0");
    }
    return target;
  }

  void read_joints_and_weights(Deformation& deformation) {
    const auto& attributes = task_.primitive->attributes;
    for (;; ++deformation.joint_sets) {
      const std::string set = "_" + std::to_string(deformation.joint_sets);
      const auto joints = attributes.find("JOINTS" + set), weights = attributes.find("WEIGHTS" + set);
      if (joints == attributes.end() || weights == attributes.end()) return;
      const auto j = read_joints(document_, joints->second, selection_, task_.where + ".attributes.JOINTS" + set);
      const auto w =
          read_vec4(document_, weights->second, Use::weights, selection_, task_.where + ".attributes.WEIGHTS" + set);
      deformation.joints.insert(deformation.joints.end(), j.begin(), j.end());
      deformation.weights.insert(deformation.weights.end(), w.begin(), w.end());
    }
  }

  // Section 3.7.3.3: the weights of a vertex sum to one.
  void normalise(Deformation& deformation) {
    constexpr float kRounding = 0.02f;  // what four weights in bytes may lose
    size_t wrong = 0;
    for (size_t v = 0; v < vertices_; ++v) {
      float sum = 0;
      bool bad = false;
      for (size_t set = 0; set < deformation.joint_sets; ++set)
        for (int k = 0; k < 4; ++k) {
          float& w = deformation.weights[set * vertices_ + v][k];
          if (!(w >= 0) || !std::isfinite(w)) w = 0, bad = true;
          sum += w;
        }
      wrong += bad || std::abs(sum - 1) > kRounding;
      // What rounding alone keeps from being one stays as the file has it.
      constexpr float kNearlyOne = 1e-6f;
      if (!bad && std::abs(sum - 1) <= kNearlyOne) continue;
      if (sum > 0 && std::isfinite(sum))
        for (size_t set = 0; set < deformation.joint_sets; ++set) deformation.weights[set * vertices_ + v] /= sum;
      else
        deformation.weights[v] = Vec4(1, 0, 0, 0);
    }
    if (wrong > 0)
      warnings_.push_back(task_.where + ": the skin weights of " + std::to_string(wrong) +
                          " vertices did not sum to 1 and were normalised");
  }

  const Document& document_;
  const MeshTask& task_;
  Selection selection_;
  size_t vertices_;
  std::vector<std::string>& warnings_;
};

}  // namespace

std::shared_ptr<Deformation> read_deformation(const Document& document, const MeshTask& task,
                                              const std::vector<uint32_t>& selection, size_t vertices,
                                              std::vector<std::string>& warnings) {
  return DeformationReader(document, task, selection, vertices, warnings).run();
}

void follow(Deformation& deformation, const std::vector<uint32_t>& sources, size_t old_vertices) {
  for (MorphTarget& target : deformation.targets)
    for (auto* values : {&target.positions, &target.normals, &target.tangents})
      if (!values->empty()) *values = chosen(*values, sources, old_vertices);
  deformation.joints = chosen(deformation.joints, sources, old_vertices);
  deformation.weights = chosen(deformation.weights, sources, old_vertices);
}

}  // namespace etendue::scene::gltf
