// What a camera records in front of a wall: irradiance on the film, vignetting, and the measurement equation from both ends
// [Lang, eq. 4.425-4.436; Foote 1915]
//
// A thin lens of radius R has the film at the distance v, which is the unit of length; R = 1 / (2 N) for the f-number N. A
// film point p has the slope s = p / v of the ray through the centre of the lens. Its ray through the lens point l has the
// slope s + l / v at the film, and s - l / F in the scene, with the distance F of the plane in focus.
//
// A wall of the constant radiance L causes the irradiance of a disk of this radiance,
//
//   E(p)  =  integral of L cos^4(theta') / v^2 over the lens
//         =  pi L / 2 (1 - (v^2 + p^2 - R^2) / sqrt((v^2 + p^2 + R^2)^2 - 4 p^2 R^2))
//         ~  pi / (4 N^2) L cos^4(theta)          for a small lens, where theta is the angle of the ray through its centre
//
// The radiance that a renderer shows is E divided by the last line without L: it has no cosines and no solid angle.
//
// Vignetting: a second stop of radius S at the distance d before the lens transmits the rays with |l + d (s - l / F)| < S. As
// seen from p, the stop is a circle that moves across the lens: the transmitted share is the overlap of two circles. Its product
// with the cosine law is an approximation, because the stop leaves one side of the lens, where cos(theta') differs.
//
// Pinhole: the mean radiance over the lens of a wall 1 + c cos(k x), at the distance w, is 1 + c cos(k w s) 2 J1(k r) / (k r),
// with the circle of confusion r = R |1 - w / F|. As R falls, the responsivity W_e becomes a delta distribution of
// directions, and the measurement the radiance along one ray. Both errors, of this contrast and of the cosine law, fall as R^2.
//
// A pinhole has two formulations: W_e = delta(w - w_e) f, in solid angle, records L cos(theta), and W_e = delta(w - w_e) f /
// cos(theta), in projected solid angle, records L [Lang, eq. 4.430-4.435]. The mean radiance M / integral of W_e [Lang, eq. 4.436]
// is the same for both, up to the variation of the cosine within a pixel.
//
// The measurement equation of a pixel, its flux, is an integral over lens and pixel, or over lens and wall:
//
//   M  =  integral of L(x) cos^4(theta') / v^2 dp dl                         from the camera
//      =  integral of L(x) G(x, l) W_e(x, l) dx dl                           from the light, G = cos^4(theta) / w^2
//
// with W_e = cos^4(theta') / cos^4(theta) for points whose image is in the pixel, as |dp / dx| = v^2 / w^2. W_e is 1 for a small
// lens only: an ideal thin lens maps slopes linearly and does not conserve etendue.
//
// The same is done with the renderer's camera, whose importance is the density of image points.
#include <array>
#include <cmath>
#include <numbers>

#include "camera/camera_ray.h"
#include "equations/quadrature.h"
#include "equations/random_numbers.h"
#include "experiments/experiment.h"
#include "experiments/moments.h"
#include "radiosity/closed_forms.h"

namespace etendue::experiments {
namespace {

using equations::RandomNumbers;

constexpr int kGroups = 32;           // of samples, for the standard error
constexpr int kAngles = 10;           // rows of the table
constexpr int kCurvePoints = 60;      // of curves without noise
constexpr double kWaves = 6;          // of the pattern, over the distance of the wall
constexpr double kContrast = 0.8;     // of the pattern
constexpr double kPixelCentre = 0.3;  // of the pixel that is measured, off the axis
constexpr double kPixelHalfWidth = 0.04;
constexpr double kSlopeTolerance = 0.05;

struct Point {
  double x = 0, y = 0;
  double squared() const { return x * x + y * y; }
};

Point disk_point(RandomNumbers& random, double radius) {
  const double r = radius * std::sqrt(random.uniform()), angle = 2 * std::numbers::pi * random.uniform();
  return {r * std::cos(angle), r * std::sin(angle)};
}

// The fourth power of the cosine of the angle between a direction of this slope and the axis.
double cos4_of(const Point& slope) {
  const double d = 1 + slope.squared();
  return 1 / (d * d);
}

// The irradiance by a disk of unit radiance at unit distance, at a point `offset` off its axis [Foote 1915].
double disk_irradiance(double radius, double offset) {
  return std::numbers::pi * radiosity::point_to_disk(radius, 1, offset);
}

// The area that two circles with this distance of their centres have in common.
double overlap_area(double a, double b, double distance) {
  constexpr double pi = std::numbers::pi;
  if (distance >= a + b) return 0;
  const double least = std::min(a, b);
  if (distance <= std::abs(a - b)) return pi * least * least;
  const double d2 = distance * distance;
  const double alpha = std::acos(std::clamp((d2 + a * a - b * b) / (2 * distance * a), -1.0, 1.0));
  const double beta = std::acos(std::clamp((d2 + b * b - a * a) / (2 * distance * b), -1.0, 1.0));
  return a * a * (alpha - std::sin(2 * alpha) / 2) + b * b * (beta - std::sin(2 * beta) / 2);
}

// A mean and its standard error, from groups of samples.
template <class F>
Moments means_of_groups(int samples, F&& sample) {
  Moments moments;
  for (int g = 0; g < kGroups; ++g) {
    double sum = 0;
    for (int i = 0; i < samples; ++i) sum += sample();
    moments.add(sum / samples);
  }
  return moments;
}

struct CameraResponse {
  static constexpr ExperimentDescription kDescription{
      .name = "camera-response",
      .label = "Camera response",
      .summary = "Irradiance on the film, vignetting, the pinhole as a limit, and measurements from both ends",
      .source = "[Lang, eq. 4.425-4.436]"};

  Number<float> f_number{"f-number", "f-number", 2, {0.5f, 64}, "Film distance over the diameter of the lens"};
  Number<float> radiance{"radiance", "Radiance", 1, {1e-3f, 1e6f}, "Radiance of the wall", "W/m\u00b2sr"};
  Number<float> angle{"angle", "Largest angle", 50, {1, 80}, "Angle of the ray through the centre of the lens",
                      "\u00b0"};
  Number<float> stop_radius{
      "stop-radius", "Radius of the stop", 0.3f, {0.001f, 10}, "Of the second stop, in film distances"};
  Number<float> stop_distance{
      "stop-distance", "Distance of the stop", 0.4f, {0, 2}, "From the lens, in film distances; 0: at the lens"};
  Number<float> wall{"wall", "Distance of the wall", 8, {1, 1000}, "In film distances"};
  Number<float> focus{"focus", "Focus distance", 4, {2.5f, 1e6f}, "Distance in focus, in film distances"};
  Number<int> samples{"samples", "Samples",         4096, {64, 1'000'000}, "Lens points of each of 32 groups",
                      "",        Scale::logarithmic};

  auto parameters() { return std::tie(f_number, radiance, angle, stop_radius, stop_distance, wall, focus, samples); }

  Result<ExperimentResult> run(const RunContext& context) const {
    ExperimentResult result;
    if (auto ok = add_angles(context, result); !ok) return ok.error();
    add_pinhole(result);
    add_formulations(result);
    if (auto ok = add_measurements(context, result); !ok) return ok.error();
    return result;
  }

 private:
  double lens_radius() const { return 0.5 / double{f_number}; }
  double lens_area() const { return std::numbers::pi * lens_radius() * lens_radius(); }
  double lens_area_over_stop() const { return 1 - double{stop_distance} / double{focus}; }

  // The area of the lens that the stop leaves, as seen along the slope s of the centre.
  double transmitted_share(double s) const {
    const double scale = lens_area_over_stop();
    return overlap_area(lens_radius(), double{stop_radius} / scale, double{stop_distance} * s / scale) / lens_area();
  }
  bool is_transmitted(const Point& lens, double s) const {
    const double d = stop_distance, scale = lens_area_over_stop();
    const Point at_stop{lens.x * scale + d * s, lens.y * scale};
    return at_stop.squared() < double{stop_radius} * double{stop_radius};
  }

  Result<void> add_angles(const RunContext& context, ExperimentResult& result) const {
    result.table.columns = {"angle, degrees", "irradiance, W/m\u00b2",  "Monte Carlo", "standard error",
                            "cos\u2074 law",  "share through the stop", "Monte Carlo"};
    metrics::FunctionCurve measured{.name = "Monte Carlo", .style = metrics::CurveStyle::dots, .points = {}},
        exact{.name = "closed form", .points = {}},
        law{.name = "cos\u2074 law", .style = metrics::CurveStyle::dashed, .points = {}},
        stopped{.name = "cos\u2074 law times share of the stop", .points = {}},
        stopped_measured{.name = "Monte Carlo with stop", .style = metrics::CurveStyle::dots, .points = {}};
    const double l = radiance, law_on_axis = l * lens_area();
    const auto law_at = [&](double s) { return law_on_axis * cos4_of({s, 0}); };
    const auto slope_at = [](double degrees) { return std::tan(degrees * std::numbers::pi / 180); };
    for (int i = 0; i <= kCurvePoints; ++i) {
      const double degrees = double{angle} * i / kCurvePoints, s = slope_at(degrees);
      exact.points.push_back({degrees, l * disk_irradiance(lens_radius(), s)});
      law.points.push_back({degrees, law_at(s)});
      stopped.points.push_back({degrees, law_at(s) * transmitted_share(s)});
    }
    for (int i = 0; i < kAngles; ++i) {
      if (!context.proceed(0.5 * i / kAngles)) return interrupted();
      const double degrees = double{angle} * i / (kAngles - 1), s = slope_at(degrees);
      RandomNumbers random(mix_bits(context.seed) + static_cast<uint64_t>(i));
      int64_t passed = 0;
      double with_stop = 0;
      const Moments irradiance = means_of_groups(samples, [&] {
        const Point lens = disk_point(random, lens_radius());
        const double value = l * lens_area() * cos4_of({s + lens.x, lens.y});
        if (is_transmitted(lens, s)) {
          ++passed;
          with_stop += value;
        }
        return value;
      });
      const double count = double{kGroups} * static_cast<double>(int{samples}), share = transmitted_share(s);
      const double found = static_cast<double>(passed) / count, expected = l * disk_irradiance(lens_radius(), s);
      result.table.rows.push_back(
          {degrees, expected, irradiance.mean(), irradiance.mean_error(), law_at(s), share, found});
      const std::string at = " at " + std::to_string(static_cast<int>(std::lround(degrees))) + "\u00b0";
      result.checks.push_back({"irradiance" + at, irradiance.mean(), expected,
                               kStandardErrors * irradiance.mean_error() + 1e-12 * expected});
      result.checks.push_back({"share through the stop" + at, found, share,
                               kStandardErrors * std::sqrt(std::max(0.0, share * (1 - share)) / count) + 10 / count});
      measured.points.push_back({degrees, irradiance.mean()});
      stopped_measured.points.push_back({degrees, with_stop / count});
    }
    result.charts.push_back(metrics::FunctionChart{.title = "Irradiance on the film",
                                                   .x_label = "angle, degrees",
                                                   .y_label = "W/m\u00b2",
                                                   .curves = {exact, law, stopped, measured, stopped_measured}});
    return {};
  }

  // The factor of the contrast of the pattern for a lens of this radius.
  double transfer(double radius) const {
    const double k = 2 * std::numbers::pi * kWaves / double{wall};
    const double x = k * radius * std::abs(1 - double{wall} / double{focus});
    return x < 1e-6 ? 1 : 2 * std::cyl_bessel_j(1.0, x) / x;
  }

  // The errors of the cosine law and of the contrast against the f-number.
  void add_pinhole(ExperimentResult& result) const {
    metrics::FunctionCurve of_law{.name = "cos\u2074 law", .points = {}}, of_contrast{.name = "contrast", .points = {}};
    constexpr double kFirst = 4;  // the f-number of the first point; others are its multiples by powers of 2
    constexpr int kDoublings = 8;
    const auto law_error = [](double radius) {
      const double small = std::numbers::pi * radius * radius * cos4_of({kPixelCentre, 0});
      return std::abs(disk_irradiance(radius, kPixelCentre) / small - 1);
    };
    for (int i = 0; i < kDoublings; ++i) {
      const double n = kFirst * std::exp2(i), radius = 0.5 / n;
      of_law.points.push_back({n, law_error(radius)});
      of_contrast.points.push_back({n, std::abs(1 - transfer(radius))});
    }
    const auto slope_of = [](const metrics::FunctionCurve& curve) {
      const auto& p = curve.points;
      return std::log2(p[p.size() - 1].y / p[p.size() - 2].y);
    };
    result.checks.push_back(
        {"slope of the error of the cos\u2074 law over the f-number", slope_of(of_law), -2, kSlopeTolerance});
    if (of_contrast.points.back().y > 1e-9)
      result.checks.push_back(
          {"slope of the error of the contrast over the f-number", slope_of(of_contrast), -2, kSlopeTolerance});
    result.charts.push_back(metrics::FunctionChart{.title = "The pinhole as the limit of a lens",
                                                   .x_label = "f-number",
                                                   .y_label = "relative error of the pinhole",
                                                   .curves = {of_law, of_contrast},
                                                   .logarithmic_x = true,
                                                   .logarithmic_y = true});
  }

  // What the two formulations of the pinhole and a lens record of a wall of constant radiance, relative to the axis.
  void add_formulations(ExperimentResult& result) const {
    metrics::FunctionCurve projected{.name = "pinhole, projected solid angle", .points = {}},
        solid{.name = "pinhole, solid angle", .style = metrics::CurveStyle::dashed, .points = {}},
        lens{.name = "irradiance by the lens", .points = {}};
    const double on_axis = disk_irradiance(lens_radius(), 0);
    for (int i = 0; i <= kCurvePoints; ++i) {
      const double degrees = double{angle} * i / kCurvePoints, theta = degrees * std::numbers::pi / 180;
      projected.points.push_back({degrees, 1});
      solid.points.push_back({degrees, std::cos(theta)});
      lens.points.push_back({degrees, disk_irradiance(lens_radius(), std::tan(theta)) / on_axis});
    }
    result.charts.push_back(metrics::FunctionChart{.title = "Response to a wall of constant radiance",
                                                   .x_label = "angle, degrees",
                                                   .y_label = "relative to the axis",
                                                   .curves = {projected, solid, lens}});
    const PinholeMeans constant = pinhole_means(0), pattern = pinhole_means(kContrast);
    result.checks.push_back({"mean radiance of a constant wall, projected solid angle", constant.projected,
                             double{radiance}, 1e-12 * double{radiance}});
    result.checks.push_back(
        {"mean radiance of a constant wall, solid angle", constant.solid, double{radiance}, 1e-12 * double{radiance}});
    // The weights of both differ by the variation of the cosine, and the radiance varies by the contrast.
    const double nearest = std::hypot(1, kPixelCentre - kPixelHalfWidth);
    const double farthest = std::hypot(1, kPixelCentre + kPixelHalfWidth, kPixelHalfWidth);
    result.checks.push_back({"mean radiance of a pattern, both formulations", pattern.solid, pattern.projected,
                             2 * kContrast * double{radiance} * (farthest / nearest - 1)});
  }

  // The mean radiance of a pixel of both formulations of the pinhole.
  struct PinholeMeans {
    double projected = 0, solid = 0;
  };
  PinholeMeans pinhole_means(double contrast) const {
    static const auto rule = equations::gauss_rule(32, 1);
    double projected = 0, solid = 0, cosines = 0;
    for (size_t i = 0; i < rule.size(); ++i)
      for (size_t j = 0; j < rule.size(); ++j) {
        const Point s{kPixelCentre + kPixelHalfWidth * (2 * rule.nodes[i] - 1),
                      kPixelHalfWidth * (2 * rule.nodes[j] - 1)};
        const double weight = rule.weights[i] * rule.weights[j], cosine = std::sqrt(std::sqrt(cos4_of(s)));
        const double value = wall_radiance(double{wall} * s.x, contrast);
        projected += weight * value;
        solid += weight * cosine * value;
        cosines += weight * cosine;
      }
    return {projected, solid / cosines};
  }

  // Radiance of the wall, with a pattern of some contrast.
  double wall_radiance(double x, double contrast) const {
    return double{radiance} * (1 + contrast * std::cos(2 * std::numbers::pi * kWaves / double{wall} * x));
  }

  static bool in_pixel(double x, double y) {
    return std::abs(x - kPixelCentre) < kPixelHalfWidth && std::abs(y) < kPixelHalfWidth;
  }

  // The square of the wall that the pixel may see through any point of the lens.
  double wall_centre() const { return kPixelCentre * double{wall}; }
  double wall_half_width() const {
    return kPixelHalfWidth * double{wall} + lens_radius() * std::abs(1 - double{wall} / double{focus}) + 1e-3;
  }
  Point wall_point(RandomNumbers& random) const {
    return {wall_centre() + wall_half_width() * (2 * random.uniform() - 1),
            wall_half_width() * (2 * random.uniform() - 1)};
  }

  Moments flux_from_camera(double contrast, uint64_t seed) const {
    RandomNumbers random(seed);
    const double w = wall, f = focus, pixel_area = 4 * kPixelHalfWidth * kPixelHalfWidth;
    return means_of_groups(samples, [&] {
      const Point s{kPixelCentre + kPixelHalfWidth * (2 * random.uniform() - 1),
                    kPixelHalfWidth * (2 * random.uniform() - 1)};
      const Point lens = disk_point(random, lens_radius());
      const double x = lens.x + w * (s.x - lens.x / f);
      return wall_radiance(x, contrast) * cos4_of({s.x + lens.x, s.y + lens.y}) * pixel_area * lens_area();
    });
  }

  Moments flux_from_light(double contrast, uint64_t seed) const {
    RandomNumbers random(seed);
    const double w = wall, f = focus, wall_area = 4 * wall_half_width() * wall_half_width();
    return means_of_groups(samples, [&] {
      const Point x = wall_point(random), lens = disk_point(random, lens_radius());
      const Point out{(x.x - lens.x) / w, (x.y - lens.y) / w};  // slope in the scene
      const Point s{out.x + lens.x / f, out.y + lens.y / f};    // of the centre: the image point
      if (!in_pixel(s.x, s.y)) return 0.0;
      const double geometry = cos4_of(out) / (w * w), importance = cos4_of({s.x + lens.x, s.y + lens.y}) / cos4_of(out);
      return wall_radiance(x.x, contrast) * geometry * importance * wall_area * lens_area();
    });
  }

  // The flux of the pixel for a constant wall, by quadrature of the closed form.
  double exact_flux() const {
    static const auto rule = equations::gauss_rule(8, 1);
    double sum = 0;
    for (size_t i = 0; i < rule.size(); ++i)
      for (size_t j = 0; j < rule.size(); ++j) {
        const Point p{kPixelCentre + kPixelHalfWidth * (2 * rule.nodes[i] - 1),
                      kPixelHalfWidth * (2 * rule.nodes[j] - 1)};
        sum += rule.weights[i] * rule.weights[j] * disk_irradiance(lens_radius(), std::sqrt(p.squared()));
      }
    return sum * double{radiance} * 4 * kPixelHalfWidth * kPixelHalfWidth;
  }

  // The mean radiance of the pattern over pixel and lens.
  double mean_radiance() const {
    const double k = 2 * std::numbers::pi * kWaves;
    const double pixel = std::sin(k * kPixelHalfWidth) / (k * kPixelHalfWidth) * std::cos(k * kPixelCentre);
    return double{radiance} * (1 + kContrast * pixel * transfer(lens_radius()));
  }

  // The renderer's camera with the pixel of the size of the whole image, whose centre is on the axis: the pattern is shifted.
  struct RendererMeans {
    Moments camera, light;
  };
  RendererMeans renderer_means(uint64_t seed) const {
    Camera camera;
    camera.yfov = static_cast<float>(2 * std::atan(kPixelHalfWidth));
    camera.lens_radius = static_cast<float>(lens_radius());
    camera.focus_distance = focus;
    const CameraRays rays(camera, 1, 1);
    const double w = wall;
    const auto shifted = [&](double x) { return wall_radiance(x + wall_centre(), kContrast); };
    const auto square = [](RandomNumbers& random) {
      const auto x = static_cast<float>(random.uniform()), y = static_cast<float>(random.uniform());
      return Vec2(x, y);
    };
    RandomNumbers random(seed);
    RendererMeans means;
    means.camera = means_of_groups(samples, [&] {
      const Vec2 raster = square(random), lens = square(random);
      const Ray ray = rays.ray(raster, lens);
      return shifted(double{ray.origin.x} - double{ray.direction.x} / double{ray.direction.z} * w);
    });
    const double wall_area = 4 * wall_half_width() * wall_half_width();
    means.light = means_of_groups(samples, [&] {
      const Point x = wall_point(random);
      const Vec3 point(static_cast<float>(x.x - wall_centre()), static_cast<float>(x.y), -static_cast<float>(w));
      const auto view = rays.view(point, square(random));
      if (!view || view->raster.x < 0 || view->raster.x > 1 || view->raster.y < 0 || view->raster.y > 1) return 0.0;
      // The power of the light that leaves the wall towards the lens is L cos(theta) dx per solid angle.
      return shifted(double{point.x}) * wall_area * double{view->wi.z} * double{view->importance};
    });
    return means;
  }

  static void add_measurement(ExperimentResult& result, const std::string& name, const Moments& m, double expected) {
    result.table.rows.push_back({name, expected, m.mean(), m.mean_error(), NAN, NAN, NAN});
    result.checks.push_back({name, m.mean(), expected, kStandardErrors * m.mean_error() + 1e-6 * expected});
  }

  Result<void> add_measurements(const RunContext& context, ExperimentResult& result) const {
    const uint64_t seed = mix_bits(context.seed + 0x5eed);
    if (!context.proceed(0.5)) return interrupted();
    add_measurement(result, "flux of a pixel from the camera, W", flux_from_camera(0, seed), exact_flux());
    if (!context.proceed(0.6)) return interrupted();
    add_measurement(result, "flux of a pixel from the light, W", flux_from_light(0, seed + 1), exact_flux());
    if (!context.proceed(0.7)) return interrupted();
    const Moments camera = flux_from_camera(kContrast, seed + 2), light = flux_from_light(kContrast, seed + 3);
    result.table.rows.push_back({std::string("the same of a pattern, from the camera"), NAN, camera.mean(),
                                 camera.mean_error(), NAN, NAN, NAN});
    result.table.rows.push_back(
        {std::string("the same of a pattern, from the light"), NAN, light.mean(), light.mean_error(), NAN, NAN, NAN});
    result.checks.push_back({"flux of a pattern, light over camera", light.mean() / camera.mean(), 1,
                             kStandardErrors * std::hypot(camera.mean_error(), light.mean_error()) / camera.mean()});
    if (!context.proceed(0.9)) return interrupted();
    const RendererMeans renderer = renderer_means(seed + 4);
    add_measurement(result, "radiance of the renderer's camera, from the camera", renderer.camera, mean_radiance());
    add_measurement(result, "radiance of the renderer's camera, from the light", renderer.light, mean_radiance());
    return {};
  }
};

}  // namespace

Experiment camera_response_experiment() { return make_experiment<CameraResponse>(); }

}  // namespace etendue::experiments
