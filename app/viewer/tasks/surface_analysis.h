// The chosen material under the instruments of core/audit, and on a ball in a light of its own; another one beside it.
//
// Measured anew with every edit, beside the rendering: a few hundredths of a second. The balls have small sessions of
// one thread each, which end after some hundred samples.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "bsdf_analysis/checks.h"
#include "bsdf_analysis/drawings.h"
#include "scene/preview.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

struct SurfaceSetup {
  Number<float> degrees{"surface.angle", "Angle of view", 45, {0, 89}, "Between the eye and the normal", "\u00b0"};
  Toggle cosine{"surface.cosine", "Times the cosine", true, "What is reflected of even light; off: f itself"};
  Choice<bsdf_analysis::Length> length{
      "surface.length", "Length", bsdf_analysis::Length::linear,
      "Of lobes: f as it is, or its fourth root, which shows what lies beneath a peak"};
  Choice<scene::PreviewLight> light{
      "surface.light", "Light on the ball", scene::PreviewLight::studio,
      "Furnace is light from everywhere alike: what neither takes nor makes light vanishes"};
  auto knobs() { return std::tie(degrees, cosine, length, light); }
};

// What was found of one material.
struct SurfaceReading {
  Material material;
  std::string name;  // of its model
  bsdf_analysis::Audit audit;
  bsdf_analysis::Slice slice;
  std::vector<bsdf_analysis::LobeSurface> lobe;
};

class SurfaceHand {
 public:
  SurfaceHand(const Editor& editor, std::function<void()> wake);

  SurfaceSetup setup;
  double turn = 145, tilt = 25;  // the eye on the lobe, degrees

  // The reading of side 0, the chosen material, or 1, the one that was kept; null until it is there, or if there is
  // none.
  const SurfaceReading* shown(size_t side) const;
  // Whether it is of the material as it is.
  bool fresh() const;
  bool running() const { return job_.running(); }
  void forget();

  // Keeps the chosen material for comparison; nothing ends it.
  void keep();
  void drop();
  bool keeps() const { return kept_.has_value(); }
  bool can_keep() const { return wanted_.has_value(); }
  const std::string& kept_name() const { return kept_name_; }

  // The ball's picture: linear, three numbers a pixel; null until its first sample.
  struct BallPicture {
    int width = 0, height = 0;
    uint32_t samples = 0;
    std::shared_ptr<const std::vector<float>> pixels;
  };
  BallPicture ball(size_t side) const { return balls_[side].picture; }
  bool has_news() const;
  static constexpr int kBall = 192;  // pixels, either way

  // Called once a frame. `material` is the chosen one, or below zero. Somebody may be looking at the badges, and at all
  // of the sheet.
  void advance(int material, bool looked_at, bool sheet);

 private:
  using Readings = std::array<std::shared_ptr<const SurfaceReading>, 2>;
  struct Asked {
    std::optional<Material> materials[2];
    float degrees = 0;
    bool cosine = true;

    friend bool operator==(const Asked&, const Asked&) = default;
  };
  Asked asked() const;
  struct Ball;
  void show_balls(bool sheet);
  static void take_picture(Ball& ball);

  const Editor& editor_;
  std::function<void()> wake_;
  std::optional<Material> wanted_, kept_;
  std::string kept_name_;
  Asked of_readings_, in_work_;
  Readings readings_;
  Job<Readings> job_;
  struct Ball {
    std::unique_ptr<render::Session> session;
    std::optional<Material> material;
    scene::PreviewLight light = scene::PreviewLight::studio;
    Environment sky;
    std::shared_ptr<const render::Frame> frame;
    BallPicture picture;
  };
  std::array<Ball, 2> balls_;
};

std::vector<ParameterInfo> surface_parameters(const SurfaceSetup& setup = {});

// The name of a material's model, as menus show it.
std::string label_of_model(const Material& material);

}  // namespace etendue::viewer
