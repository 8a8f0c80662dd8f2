// What one pixel's samples are like: drawn beside the rendering, the first ones first, as many as are asked for.
#pragma once
#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "film/tail.h"
#include "render/pixel_samples.h"
#include "render/session.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

// Samples by their luminance. What is exactly zero is counted apart: a logarithm has no place for it, and it says
// something.
struct Histogram {
  bool logarithmic = false;  // of the luminance
  double low = 0, high = 1;  // of the bins
  std::vector<uint32_t> counts;
  uint32_t zeros = 0;
};
Histogram histogram_of(const std::vector<float>& values);

// Luminances in W/(m^2 sr).
struct PixelStudy {
  // After so many samples: the mean, that of either half, and how far the truth may be from the mean in 95 of 100
  // cases.
  struct Moment {
    uint32_t samples = 0;
    double mean = 0, band = 0;
    std::array<double, 2> halves{};
  };

  Vec2i pixel{0};
  uint32_t wanted = 0;
  Rgb mean;
  double deviation = 0, largest = 0;  // of the samples
  film::Tail tail;
  std::vector<Moment> course;
  Histogram histogram;

  uint32_t samples() const { return course.empty() ? 0 : course.back().samples; }
};

class PixelProbe {
 public:
  PixelProbe(const render::Session& session, const Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), job_(std::move(wake)) {}
  ~PixelProbe() { drop(); }
  PixelProbe(const PixelProbe&) = delete;
  PixelProbe& operator=(const PixelProbe&) = delete;

  void choose(Vec2i pixel) { pixel_ = pixel; }
  const std::optional<Vec2i>& pixel() const { return pixel_; }

  // Called once a frame while somebody looks, with the number of samples to draw; an edit of the light starts again.
  // True if there is something new.
  bool advance(uint32_t wanted);
  // Whether there is more to come.
  bool busy() const { return pixel_ && !settled_; }
  // Stops drawing; what there is stays.
  void rest() { drop(); }
  // Of the pixel that is chosen; none yet.
  std::shared_ptr<const PixelStudy> study() const { return pixel_ ? study_ : nullptr; }

 private:
  // What the samples depend on.
  struct Key {
    std::shared_ptr<const scene::CompiledScene> scene;
    Vec2i pixel{0};
    uint32_t wanted = 0;
    Camera camera;
    int width = 0, height = 0;
    film::FilterKind filter{};
    render::MethodSettings method;
    std::vector<std::string> forced_flags;
    uint64_t seed = 0;

    friend bool operator==(const Key&, const Key&) = default;
  };
  struct RenderState;

  void drop();

  const render::Session& session_;
  const Editor& editor_;
  std::optional<Vec2i> pixel_;
  std::optional<Key> key_;
  bool settled_ = false;               // the study is that of the present picture, and whole
  std::shared_ptr<RenderState> work_;  // one job at a time has its hands on it
  std::shared_ptr<const PixelStudy> study_;
  Job<std::shared_ptr<const PixelStudy>> job_;
};

}  // namespace etendue::viewer
