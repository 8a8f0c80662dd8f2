// Renders the contribution of each technique of a bidirectional integrator as small images [Veach and Guibas 1995].
//
// A path of k edges can be sampled by k + 2 techniques (s, t): s vertices are sampled from the light and t = k + 1 - s
// from the camera. The images of one length form a row, as in [Lang, fig. 9.25]. They are rendered one after the other
// beside the main rendering, with more samples in each round. An edit of the view or the integrator restarts them.
#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "render/document.h"
#include "viewer/tasks/progressive_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

struct TechniqueImage {
  int s = 0;
  int t = 0;
  std::string unavailable{};  // why there is no image; empty if there is or will be one
  uint32_t samples = 0;       // per pixel
  double mean = 0;            // luminance of the image, cd/m^2
  double standard_error = 0;  // of `mean`
  std::shared_ptr<const std::vector<float>> pixels = nullptr;  // linear radiance, three numbers per pixel

  int edges() const { return s + t - 1; }
};

struct TechniqueImages {
  int width = 0;  // of each image
  int height = 0;
  TechniqueImage combined;             // all techniques with MIS weights
  std::vector<TechniqueImage> images;  // in order of path length, then of s

  // The mean of an image relative to that of the combined image; nothing while one of them is unknown.
  std::optional<double> share(const TechniqueImage& image) const;
  // The sum of all shares with its standard error, an upper bound that holds also where the images have independent
  // noise: during rendering they have different numbers of samples.
  struct Sum {
    double share = 0, error = 0;
  };
  Sum sum() const;
};

class TechniqueTask final : public Task {
 public:
  struct Parameters {
    Toggle weighted{"techniques.weighted", "Apply MIS weights", true,
                    "On: the contribution of each technique to the image. Off: what each technique estimates alone"};
    Number<int> longest{
        "techniques.longest", "Max. path length", 4, {1, 8}, "Number of edges of the paths in the last row"};
    Number<int> samples{"techniques.samples",
                        "Samples",
                        128,
                        {2, 65536},
                        "Samples per pixel of each small image. More samples reduce noise",
                        "spp",
                        Scale::logarithmic};
    Number<float> exposure{"techniques.exposure",
                           "Exposure",
                           0,
                           {-10, 20},
                           "Exposure of the small images, relative to that of the main image",
                           "EV"};
    auto all() { return std::tie(weighted, longest, samples, exposure); }
  };
  Parameters parameters;

  // Whether the integrator of the document has techniques.
  static bool is_available(const render::Document& document);
  // The techniques that the document disables, as integrator::Techniques reads them. Requires `is_available`.
  static std::string disabled_techniques(const render::Document& document);
  // The qualified name of the parameter with the disabled techniques.
  static std::string disabled_parameter(const render::Document& document);

  // Called once per frame. Renders if `allowed`.
  void update(const TaskContext& context, bool allowed);
  void reset(const TaskContext& context) override;
  bool has_update() const override { return task_.has_update(); }
  bool is_saving() const override { return export_.running(); }
  bool running() const { return task_.running(); }

  // Null until the first image is rendered.
  const TechniqueImages* result() const { return task_.result().get(); }
  // Whether the result belongs to this document, and whether all images have their samples.
  bool is_current(const render::Document& document) const;
  bool is_complete(const render::Document& document) const { return is_current(document) && !running() && complete_; }

  // Writes all images in the background: .exr with a layer "technique.S.T" for each, .png as a grid.
  void save(const TaskContext& context, const std::string& file);

 private:
  using Clock = std::chrono::steady_clock;
  bool same_question(const render::Document& document) const;

  render::Document document_;       // of the images
  Parameters rendered_parameters_;  // likewise
  bool complete_ = false;
  uint64_t edited_version_ = 0;  // the document version at the last call of `update`
  Clock::time_point edit_time_;
  ProgressiveTask<TechniqueImages> task_;
  BackgroundTask<Result<std::string>> export_;
};

// Adds a technique to a set of techniques; if the set contains it, removes all words that contain it instead.
std::string toggle_technique(const std::string& set, int s, int t);

// A sentence that describes how technique (s, t) samples a path.
std::string describe_technique(int s, int t);

}  // namespace etendue::viewer
