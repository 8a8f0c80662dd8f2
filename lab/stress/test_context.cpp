#include "stress/test_context.h"

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

}  // namespace

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::vector<std::string> unbiased_integrators() {
  const auto& all = transport::PathExpression::without_volumes().automaton();
  render::Document document = *render::new_document("cornell");
  const auto scene = scene::compile(document.scene, document.camera, nullptr);
  std::vector<std::string> names;
  for (const auto& info : integrator::integrator_infos()) {
    document.method.integrator = info.name;
    if (info.bias == integrator::Bias::unbiased && render::incompatibility(document, *scene).empty() &&
        transport::Automaton::difference(all, transport::PathExpression::parse_paths(info.paths)->automaton())->empty())
      names.push_back(info.name);
  }
  return names;
}

Camera narrow_camera(const Vec3& eye, const Vec3& target) { return look_at(eye, target, {0, 1, 0}, 1e-4f); }

scene::Scene uniform_sky() {
  scene::Scene scene;
  scene.environment.tint = Rgb(1);
  return scene;
}

render::Document TestContext::document(scene::Scene scene, const Camera& camera) const {
  if (scene.materials.empty()) scene.materials.emplace_back();
  render::Document d;
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  d.camera = camera;
  d.width = d.height = options_.size;
  d.seed = options_.seed;
  return d;
}

render::Document TestContext::with_method(const render::Document& document, const std::string& method) {
  return bench::parse_method(method, document)->document;
}

film::Film TestContext::render(const render::Document& document, uint32_t samples) {
  film::Film film = render::rendered(document, samples, options_.threads);
  image_ = thumbnail_of(film);
  return film;
}

film::Tail TestContext::tail(const render::Document& document, uint32_t samples) {
  render::Document limited = document;
  limited.limits = {samples, 0, 0};
  render::Session session({.threads = options_.threads});
  session.submit(limited);
  session.finish();
  image_ = thumbnail_of(session.film_copy());
  return session.status().reliability->tail;
}

double TestContext::squared_error(const render::Document& document, uint32_t samples) {
  render::Document other = document;
  other.seed = document.seed + 1;
  const film::Film a = render(document, samples), b = render(other, samples);
  double sum = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) sum += sqr(double{average(a.mean(x, y)) - average(b.mean(x, y))}) / 2;
  return sum / (a.width() * a.height());
}

void TestContext::add(const std::string& method, const std::string& point, std::string expectation, double measured,
                      bool ok) {
  results_.push_back({.method = method,
                      .expectation = point.empty() ? std::move(expectation) : point + ": " + expectation,
                      .measured = measured,
                      .ok = ok,
                      .image = image_});
}

void TestContext::expect_near(const std::string& method, const std::string& point, double measured, double expected,
                              double relative_tolerance) {
  add(method, point, number(expected) + " within " + number(100 * relative_tolerance) + " %", measured,
      std::abs(measured - expected) <= relative_tolerance * std::abs(expected));
}

void TestContext::expect_mean(const std::string& method, const std::string& point, const film::Mean& measured,
                              double expected) {
  // The second term bounds rounding errors of float sums, which remain without noise.
  const double margin = kSigmas * measured.standard_error + 2e-5 * std::abs(expected);
  add(method, point, number(expected) + " +- " + number(margin), measured.value,
      std::abs(measured.value - expected) <= margin);
}

void TestContext::expect_between(const std::string& method, const std::string& point, double measured, double minimum,
                                 double maximum) {
  add(method, point, number(minimum) + " to " + number(maximum), measured, measured >= minimum && measured <= maximum);
}

void TestContext::expect_zero(const std::string& method, const std::string& point, double measured) {
  add(method, point, "0", measured, measured == 0);
}

std::vector<TestResult> TestContext::take_results() {
  image_ = {};
  return std::exchange(results_, {});
}

}  // namespace etendue::stress
