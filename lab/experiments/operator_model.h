// The operators of light transport between the patches of a scene, and pictures of values on its patches.
#pragma once
#include <memory>
#include <string>

#include "camera/camera.h"
#include "equations/transport_matrices.h"
#include "experiments/experiment.h"
#include "radiosity/patch_mesh.h"
#include "radiosity/scene_solution.h"

namespace etendue::experiments {

inline constexpr int kViewSize = 64;  // pixels of the pictures
inline constexpr double kFurnaceAlbedo = 0.75;
inline constexpr const char* kFurnaceScene = "furnace";

// An error unless the text is "furnace", a built-in scene, or a .gltf or .glb file.
Result<void> check_operator_scene(std::string_view text);

// The scene and the camera of such a text. The furnace is a closed cube of this albedo that emits radiance 1.
struct OperatorScene {
  std::shared_ptr<const scene::Scene> scene;
  Camera camera;
};
Result<OperatorScene> operator_scene(const std::string& text, double furnace_albedo = kFurnaceAlbedo);

// A scene, and the sides of its patches that see another side: the elements of the matrices. Green light only.
class OperatorModel {
 public:
  // An input error if the scene has more triangles than matrices can hold.
  static Result<OperatorModel> make(const OperatorScene& scene, int patches);

  // An error if the scene does not emit light, or if `context` ends the run.
  Result<void> build(const RunContext& context);

  const equations::TransportMatrices& matrices() const { return matrices_; }
  // The exitant radiance of the sources. Lights that have no patches enter as the light that patches reflect from them.
  const equations::Vector& emitted() const { return emitted_; }
  bool has_external_lights() const { return has_external_lights_; }

  // The element that the camera sees in each pixel of a picture, row by row from the top; -1 for none.
  const std::vector<int>& visible_elements() const { return visible_; }
  // The share of the picture that each element fills, per area and solid angle: the camera's incident importance.
  equations::Vector camera_importance() const;
  // A picture of one value per element.
  metrics::MatrixChart picture(std::string title, const equations::Vector& values) const;

 private:
  OperatorModel(const OperatorScene& scene, int patches);
  void collect(const radiosity::SceneSolution& solution);
  void find_visible_elements();
  Rgb emission_of(uint32_t side) const;

  Camera camera_;
  std::shared_ptr<const scene::CompiledScene> scene_;
  radiosity::PatchMesh mesh_;
  std::vector<uint32_t> sides_;  // of the elements
  std::vector<int> element_of_;  // by side; -1 for sides that see nothing
  std::vector<int> visible_;
  equations::TransportMatrices matrices_;
  equations::Vector emitted_;
  bool has_external_lights_ = false;
};

}  // namespace etendue::experiments
