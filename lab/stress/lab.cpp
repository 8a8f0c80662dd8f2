#include "stress/lab.h"

#include <cmath>
#include <cstdio>

#include "bench/method_spec.h"
#include "film/film_image.h"
#include "image/display.h"
#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "render/session.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::stress {
namespace {

Thumbnail thumbnail_of(const film::Film& film) {
  return {film.width(), film.height(), image::display_pixels(film::radiance_of(film), 0, image::ToneCurve::agx)};
}

std::string at(const std::string& point, const std::string& text) { return point.empty() ? text : point + ": " + text; }

}  // namespace

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::vector<std::string> unbiased_methods() {
  const auto& all = transport::PathExpression::all().automaton();
  render::Document view = *render::new_document("cornell");
  const auto scene = scene::compile(view.scene, view.camera, nullptr);
  std::vector<std::string> names;
  for (const auto& info : integrator::integrator_infos()) {
    view.method.integrator = info.name;
    if (info.bias == integrator::Bias::unbiased && render::incompatibility(view, *scene).empty() &&
        transport::PathExpression::parse_paths(info.paths)->automaton() == all)
      names.push_back(info.name);
  }
  return names;
}

Camera telescope(const Vec3& eye, const Vec3& target) { return look_at(eye, target, {0, 1, 0}, 1e-4f); }

render::Document Lab::document(scene::Scene scene, const Camera& camera) const {
  if (scene.materials.empty()) scene.materials.emplace_back();
  render::Document d;
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  d.camera = camera;
  d.width = d.height = options_.size;
  d.seed = options_.seed;
  return d;
}

render::Document Lab::with_method(const render::Document& document, const std::string& method) {
  return bench::parse_method(method, document)->document;
}

film::Film Lab::render(const render::Document& document, uint32_t samples) {
  film::Film film = render::rendered(document, samples, options_.threads);
  picture_ = thumbnail_of(film);
  return film;
}

film::Tail Lab::tail(const render::Document& document, uint32_t samples) {
  render::Document limited = document;
  limited.limits = {samples, 0, 0};
  render::Session session({.threads = options_.threads});
  session.submit(limited);
  session.finish();
  picture_ = thumbnail_of(session.film_copy());
  return session.status().reliability->tail;
}

double Lab::squared_error(const render::Document& document, uint32_t samples) {
  render::Document other = document;
  other.seed = document.seed + 1;
  const film::Film a = render(document, samples), b = render(other, samples);
  double sum = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) sum += sqr(double{average(a.mean(x, y)) - average(b.mean(x, y))}) / 2;
  return sum / (a.width() * a.height());
}

void Lab::add(const std::string& method, const std::string& point, std::string expectation, double measured, bool ok) {
  findings_.push_back({method, at(point, expectation), measured, ok, picture_});
}

void Lab::expect_near(const std::string& method, const std::string& point, double measured, double expected,
                      double relative) {
  add(method, point, number(expected) + " within " + number(100 * relative) + " %", measured,
      std::abs(measured - expected) <= relative * std::abs(expected));
}

void Lab::expect_mean(const std::string& method, const std::string& point, const film::Mean& measured,
                      double expected) {
  // Rounding errors of float sums stand where there is no noise.
  const double margin = kSigmas * measured.standard_error + 2e-5 * std::abs(expected);
  add(method, point, number(expected) + " +- " + number(margin), measured.value,
      std::abs(measured.value - expected) <= margin);
}

void Lab::expect_between(const std::string& method, const std::string& point, double measured, double least,
                         double most) {
  add(method, point, number(least) + " to " + number(most), measured, measured >= least && measured <= most);
}

void Lab::expect_zero(const std::string& method, const std::string& point, double measured) {
  add(method, point, "0", measured, measured == 0);
}

std::vector<Finding> Lab::take_findings() {
  picture_ = {};
  return std::exchange(findings_, {});
}

}  // namespace etendue::stress
