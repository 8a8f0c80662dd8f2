#include "light/environments/sky.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <utility>
#include <vector>

#include "light/environments/hosek_model.h"
#include "light/environments/map_of_radiance.h"
#include "light/environments/sky_color.h"

namespace etendue {
namespace {

constexpr double kPiD = 3.14159265358979;
constexpr float kLimbDarkening = 0.6f;

// A distribution over the sky: F = (1 + a exp(b / cos theta)) (1 + c exp(d gamma) + e cos^2 gamma), with the angles
// theta to the zenith and gamma to the sun [Perez et al. 1993].
struct PerezFunction {
  double a, b, c, d, e;

  double operator()(double cos_theta, double gamma) const {
    const double cos_gamma = std::cos(gamma);
    return (1 + a * std::exp(b / cos_theta)) * (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
  }
};

// A cubic polynomial of the sun's zenith angle whose coefficients are quadratic in the turbidity.
double zenith_chromaticity(const double (&m)[3][4], double turbidity, double theta) {
  const double powers[] = {turbidity * turbidity, turbidity, 1};
  double sum = 0;
  for (int row = 0; row < 3; ++row)
    sum += powers[row] * (((m[row][0] * theta + m[row][1]) * theta + m[row][2]) * theta + m[row][3]);
  return sum;
}

constexpr double kZenithX[3][4] = {
    {0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}};
constexpr double kZenithY[3][4] = {
    {0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}};

Rgb rgb_of_xyy(double x, double y, double luminance) {
  return rgb_of_sky(x / y * luminance, luminance, (1 - x - y) / y * luminance);
}

// The model for one position of the sun [Preetham et al. 1999, appendix A.2].
class PreethamSky {
 public:
  explicit PreethamSky(const Sky& sky) : sun_(sun_direction(sky)) {
    const double t = sky.turbidity;
    theta_ = kPiD / 2 - std::clamp(static_cast<double>(sun_angles(sky).elevation), 0.0, kPiD / 2);
    luminance_ = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                  -0.0670 * t + 0.3703};
    x_ = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
    y_ = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};
    const double chi = (4.0 / 9 - t / 120) * (kPiD - 2 * theta_);
    const double zenith = 1000 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192);  // cd/m^2
    scale_ = {std::max(zenith, 0.0) / luminance_(1, theta_), zenith_chromaticity(kZenithX, t, theta_) / x_(1, theta_),
              zenith_chromaticity(kZenithY, t, theta_) / y_(1, theta_)};
  }

  Rgb radiance(const Vec3& direction) const {
    constexpr double kLowestCosine = 1e-3;  // the horizon itself
    const double cosine = std::max(static_cast<double>(direction.y), kLowestCosine);
    const double gamma = std::acos(std::clamp(static_cast<double>(glm::dot(direction, sun_)), -1.0, 1.0));
    return rgb_of_xyy(scale_[1] * x_(cosine, gamma), scale_[2] * y_(cosine, gamma),
                      scale_[0] * luminance_(cosine, gamma));
  }

 private:
  Vec3 sun_;
  double theta_;  // of the sun, from the zenith
  PerezFunction luminance_{}, x_{}, y_{};
  std::array<double, 3> scale_{};
};

// Of the horizontal by the sky, lx, from the map with the rows above the horizon.
Rgb illuminance_of(const image::Image& map) {
  Rgb sum(0);
  const float step = kPi / static_cast<float>(map.height);
  for (int row = 0; row < map.height / 2; ++row) {
    const float theta = (static_cast<float>(row) + 0.5f) * step;
    const float weight = std::cos(theta) * std::sin(theta) * step * 2 * kPi / static_cast<float>(map.width);
    for (int column = 0; column < map.width; ++column) {
      const auto at = static_cast<size_t>(3 * (row * map.width + column));
      sum += Rgb(map.floats[at], map.floats[at + 1], map.floats[at + 2]) * weight;
    }
  }
  return sum;
}

template <class Model>
image::Image map_above_horizon(const Model& model) {
  return *environment_map_of(
      [&](const Vec3& direction) { return direction.y > 0 ? model.radiance(direction) : Rgb(0); });
}

std::shared_ptr<const image::Image> map_of(const Sky& sky) {
  auto map = std::make_shared<image::Image>(sky.model == SkyModel::preetham ? map_above_horizon(PreethamSky(sky))
                                                                            : map_above_horizon(HosekSky(sky)));
  Rgb illuminance = illuminance_of(*map);
  if (sky.sun_disk) illuminance += sun_radiance(sky) * (solid_angle_of_sun() * std::sin(sun_angles(sky).elevation));
  const Rgb ground = illuminance * (sky.ground_albedo * kInvPi);
  for (size_t at = map->floats.size() / 2; at < map->floats.size(); ++at)
    map->floats[at] = ground[static_cast<int>(at % 3)];
  return map;
}

std::shared_ptr<const image::Image> shared_map_of(const Sky& sky) {
  static std::mutex mutex;
  static std::vector<std::pair<Sky, std::weak_ptr<const image::Image>>> maps;
  const std::scoped_lock lock(mutex);
  std::erase_if(maps, [](const auto& entry) { return entry.second.expired(); });
  for (const auto& [known, map] : maps)
    if (known == sky)
      if (auto shared = map.lock()) return shared;
  auto map = map_of(sky);
  maps.emplace_back(sky, map);
  return map;
}

}  // namespace

Rgb sky_radiance(const Sky& sky, const Vec3& direction) {
  return sky.model == SkyModel::preetham ? PreethamSky(sky).radiance(direction) : HosekSky(sky).radiance(direction);
}

Environment make_sky(const Sky& sky) {
  Environment environment;
  environment.map = shared_map_of(sky);
  environment.file = sky.model == SkyModel::preetham ? kSky.name : kHosekSkyName;
  environment.tint = Rgb(1);
  environment.sky = sky;
  if (sky.sun_disk && sun_angles(sky).is_up)
    environment.sun = SunDisk{.direction = sun_direction(sky),
                              .radiance = sun_radiance(sky),
                              .angular_radius = kSunAngularRadius,
                              .limb_darkening = kLimbDarkening};
  return environment;
}

}  // namespace etendue
