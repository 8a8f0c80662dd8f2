#include "viewer/tasks/surface_analysis.h"

#include <algorithm>

namespace etendue::viewer {
namespace {

constexpr uint32_t kBallSamples = 400;

std::shared_ptr<const SurfaceReading> read(const Material& material, double degrees, bool cosine) {
  auto reading = std::make_shared<SurfaceReading>();
  const bsdf_analysis::Lobes lobes = bsdf_analysis::lobes_of(material);
  reading->material = material, reading->name = label_of_model(material);
  reading->audit = bsdf_analysis::audit(lobes);
  reading->slice = bsdf_analysis::slice(lobes, degrees, cosine);
  reading->lobe.push_back(bsdf_analysis::lobe_surface(lobes, degrees, bsdf_analysis::Side::upper, cosine));
  if (bsdf_analysis::passes_light(lobes))
    reading->lobe.push_back(bsdf_analysis::lobe_surface(lobes, degrees, bsdf_analysis::Side::lower, cosine));
  return reading;
}

render::Document document_of(const scene::Scene& from, const Material& material, scene::PreviewLight light) {
  render::Document d;
  d.scene = std::make_shared<scene::Scene>(scene::preview_scene(from, material, light));
  d.camera = scene::preview_camera();
  d.width = d.height = SurfaceHand::kBall;
  d.limits.samples = kBallSamples;
  return d;
}

}  // namespace

SurfaceHand::SurfaceHand(const Editor& editor, std::function<void()> wake)
    : editor_(editor), wake_(std::move(wake)), job_(wake_) {}

const SurfaceReading* SurfaceHand::shown(size_t side) const { return readings_[side].get(); }

SurfaceHand::Asked SurfaceHand::asked() const { return {{wanted_, kept_}, setup.degrees, setup.cosine}; }

bool SurfaceHand::fresh() const { return wanted_ && readings_[0] && of_readings_ == asked(); }

void SurfaceHand::forget() {
  job_.abandon();
  wanted_.reset(), kept_.reset();
  readings_ = {};
}

void SurfaceHand::keep() {
  if (!wanted_) return;
  kept_ = wanted_;
  kept_name_ = label_of_model(*kept_);
}

void SurfaceHand::drop() { kept_.reset(), readings_[1].reset(); }

bool SurfaceHand::has_news() const {
  const auto drawn_anew = [](const Ball& ball) { return ball.session && ball.session->frame() != ball.frame; };
  return std::any_of(balls_.begin(), balls_.end(), drawn_anew);
}

void SurfaceHand::take_picture(Ball& ball) {
  const auto frame = ball.session->frame();
  if (!frame || frame == ball.frame) return;
  auto pixels = std::make_shared<std::vector<float>>();
  pixels->reserve(3 * frame->pixels->size());
  for (const Rgb& c : *frame->pixels) pixels->insert(pixels->end(), {c.r, c.g, c.b});
  ball.frame = frame;
  ball.picture = {frame->width, frame->height, frame->samples, std::move(pixels)};
}

void SurfaceHand::advance(int material, bool looked_at, bool sheet) {
  wanted_.reset();
  if (!editor_.empty() && material >= 0 && static_cast<size_t>(material) < editor_.document().scene->materials.size())
    wanted_ = editor_.document().scene->materials[static_cast<size_t>(material)];
  if (auto done = job_.take()) readings_ = std::move(*done), of_readings_ = in_work_;
  if (!wanted_) readings_[0].reset();
  if (looked_at && wanted_ && !job_.running() && !fresh()) {
    in_work_ = asked();
    job_.start([asked = in_work_, before = of_readings_, readings = readings_] {
      Readings found;
      const bool same_look = asked.degrees == before.degrees && asked.cosine == before.cosine;
      for (size_t side = 0; side < 2; ++side) {
        if (!asked.materials[side]) continue;
        const bool same = same_look && readings[side] && asked.materials[side] == before.materials[side];
        found[side] =
            same ? readings[side] : read(*asked.materials[side], static_cast<double>(asked.degrees), asked.cosine);
      }
      return found;
    });
  }
  show_balls(sheet);
}

void SurfaceHand::show_balls(bool sheet) {
  for (size_t side = 0; side < 2; ++side) {
    Ball& ball = balls_[side];
    const auto& material = side == 0 ? wanted_ : kept_;
    if (!sheet || !material) {
      // Nobody looks. Its threads rest; to end them would wait for what they compile.
      if (ball.session) ball.session->pause(true);
      if (!material) ball.picture = {}, ball.material.reset();
      continue;
    }
    const auto& scene = *editor_.document().scene;
    const bool same_sky = setup.light != scene::PreviewLight::scene || ball.sky == scene.environment;
    if (ball.session) take_picture(ball);
    if (ball.session && ball.material == material && ball.light == setup.light && same_sky) {
      ball.session->pause(false);
      continue;
    }
    if (!ball.session) {
      ball.session = std::make_unique<render::Session>(render::SessionOptions{.threads = 1, .interactive = true});
      ball.session->on_update(wake_);
    }
    ball.session->pause(false);
    ball.material = material, ball.light = setup.light, ball.sky = scene.environment;
    ball.session->submit(document_of(scene, *material, setup.light));
  }
}

std::vector<ParameterInfo> surface_parameters(const SurfaceSetup& setup) {
  return describe_all(SurfaceSetup(setup).knobs());
}

std::string label_of_model(const Material& material) {
  return material.model ? material.model->info().description.label : "glTF surface";
}

}  // namespace etendue::viewer
