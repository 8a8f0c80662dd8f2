// What an integrator is to the rest of the program: a description, parameters, and a way to sample a run of pixels.
//
// It is chosen once per pass through a virtual call; inside, the hot loop is a template over the transport model.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "camera/camera_ray.h"
#include "film/filter.h"
#include "sampling/sampler.h"
#include "scene/compiled.h"
#include "transport/model.h"

namespace etendue::integrator {

enum class Bias { unbiased, consistent, biased };
std::string_view bias_name(Bias bias);

struct IntegratorInfo {
  std::string name, label, doc;
  std::string paths;  // the light paths it finds, in Heckbert's notation as the thesis extends it (8.1)
  // Those among them that it finds even if the light has no extent (point, spot, directional); empty if none.
  std::string point_paths;
  Bias bias = Bias::unbiased;
  std::string cost, fails;
  std::vector<ParameterInfo> parameters;
};

// Everything of a pass that does not change from pixel to pixel.
struct Pass {
  const scene::CompiledScene* scene;
  const transport::Model* model;
  const Sampler* sampler;
  const CameraRays* camera;
  const film::Filter* filter;
  uint64_t seed;                                  // the user's
  const std::function<bool()>* wanted = nullptr;  // asked now and then: a block is given up if nobody wants it any more
};

// One sample of each pixel of a rectangle, kWidth x kHeight pixels at most.
struct PixelBlock {
  static constexpr int kWidth = 32, kHeight = 16;
  static constexpr size_t kMostPixels = size_t{kWidth} * kHeight;
  int x, y, width, height;
  uint32_t sample;  // counts all samples of a pixel: it alternates between the film's halves
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual std::vector<ParameterInfo> parameters() const = 0;
  virtual bool set(std::string_view name, const Value& value) = 0;
  // Fills `radiance`, row by row of the block, and returns the number of rays traced; nothing if it was given up.
  virtual std::optional<uint64_t> sample(const Pass& pass, const PixelBlock& block, std::span<Rgb> radiance) const = 0;
};

const std::vector<IntegratorInfo>& integrator_infos();
const IntegratorInfo* find_integrator(std::string_view name);

// Whether an integrator finds any of the paths that an expression (PathExpression::parse_paths takes it, or it is
// empty) stands for. What it does not find is missing from its image, or black.
bool finds_any(const IntegratorInfo& info, std::string_view paths);

// `settings` must have been checked; names the integrator does not have are ignored.
std::unique_ptr<Integrator> make_integrator(std::string_view name, const std::vector<Setting>& settings = {});

}  // namespace etendue::integrator
