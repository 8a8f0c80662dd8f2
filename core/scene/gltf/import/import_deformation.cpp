// Imports morph targets, joint indices and joint weights.                             glTF 2.0, sections 3.7.2.2, 3.7.3
#include "scene/coordinate_range.h"
#include "scene/gltf/import/accessor.h"
#include "scene/gltf/import/importers.h"

namespace etendue::scene::gltf {
namespace {

// The values of the vertices `sources`, for each block of `old_vertices` values.
template <class T>
std::vector<T> selected(const std::vector<T>& values, const std::vector<uint32_t>& sources, size_t old_vertices) {
  std::vector<T> result;
  result.reserve(values.size() / std::max<size_t>(old_vertices, 1) * sources.size());
  for (size_t first = 0; first + old_vertices <= values.size() && old_vertices > 0; first += old_vertices)
    for (const uint32_t v : sources) result.push_back(values[first + v]);
  return result;
}

class DeformationReader {
 public:
  DeformationReader(const InputFile& input, const MeshTask& task, const std::vector<uint32_t>& selection,
                    size_t vertices, std::vector<std::string>& warnings)
      : input_(input),
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
      const bool position = values == &target.positions;
      *values = read_vec3(input_, found->second, position ? AccessorUse::morph_position : AccessorUse::morph_direction,
                          selection_, where);
      size_t invalid = 0;
      for (Vec3& v : *values) {
        if (is_within_range(v)) continue;
        v = Vec3(0);
        ++invalid;
      }
      if (invalid > 0)
        warnings_.push_back(where + ": " + std::to_string(invalid) +
                            " displacements that are not finite or beyond 1e9 m were replaced by 0");
    }
    return target;
  }

  void read_joints_and_weights(Deformation& deformation) {
    const auto& attributes = task_.primitive->attributes;
    for (;; ++deformation.joint_sets) {
      const std::string set = "_" + std::to_string(deformation.joint_sets);
      const auto joints = attributes.find("JOINTS" + set), weights = attributes.find("WEIGHTS" + set);
      if (joints == attributes.end() || weights == attributes.end()) return;
      const auto j = read_joints(input_, joints->second, selection_, task_.where + ".attributes.JOINTS" + set);
      const auto w = read_vec4(input_, weights->second, AccessorUse::weights, selection_,
                               task_.where + ".attributes.WEIGHTS" + set);
      deformation.joints.insert(deformation.joints.end(), j.begin(), j.end());
      deformation.weights.insert(deformation.weights.end(), w.begin(), w.end());
    }
  }

  // glTF 2.0, section 3.7.3.3: the weights of a vertex sum to 1.
  void normalise(Deformation& deformation) {
    constexpr float kQuantisation = 0.02f;  // largest error of the sum of weights that are stored in bytes
    size_t repaired = 0;
    for (size_t v = 0; v < vertices_; ++v) {
      float sum = 0;
      bool invalid = false;
      for (size_t set = 0; set < deformation.joint_sets; ++set)
        for (int k = 0; k < 4; ++k) {
          float& w = deformation.weights[set * vertices_ + v][k];
          if (!(w >= 0) || !std::isfinite(w)) {
            w = 0;
            invalid = true;
          }
          sum += w;
        }
      repaired += invalid || std::abs(sum - 1) > kQuantisation;
      // Within rounding of 1, the values of the file are kept bit for bit.
      constexpr float kRounding = 1e-6f;
      if (!invalid && std::abs(sum - 1) <= kRounding) continue;
      if (sum > 0 && std::isfinite(sum))
        for (size_t set = 0; set < deformation.joint_sets; ++set) deformation.weights[set * vertices_ + v] /= sum;
      else
        deformation.weights[v] = Vec4(1, 0, 0, 0);
    }
    if (repaired > 0)
      warnings_.push_back(task_.where + ": the joint weights of " + std::to_string(repaired) +
                          " vertices do not sum to 1; they were normalised");
  }

  const InputFile& input_;
  const MeshTask& task_;
  VertexSelection selection_;
  size_t vertices_;
  std::vector<std::string>& warnings_;
};

}  // namespace

std::shared_ptr<Deformation> read_deformation(const InputFile& input, const MeshTask& task,
                                              const std::vector<uint32_t>& selection, size_t vertices,
                                              std::vector<std::string>& warnings) {
  return DeformationReader(input, task, selection, vertices, warnings).run();
}

void reorder_vertices(Deformation& deformation, const std::vector<uint32_t>& sources, size_t old_vertices) {
  for (MorphTarget& target : deformation.targets)
    for (auto* values : {&target.positions, &target.normals, &target.tangents})
      if (!values->empty()) *values = selected(*values, sources, old_vertices);
  deformation.joints = selected(deformation.joints, sources, old_vertices);
  deformation.weights = selected(deformation.weights, sources, old_vertices);
}

}  // namespace etendue::scene::gltf
