#include "light/photometry_source.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "light/photometry_reader.h"

namespace etendue {

const std::array<Option, 4> kPhotometryProfiles{{{"uniform", "Uniform"},
                                                 {"cosine", "Cosine (Lambertian)"},
                                                 {"batwing", "Batwing (even illuminance)"},
                                                 {"street", "Street light"}}};

namespace {

float fall(float x, float from, float to) {
  const float t = std::clamp((to - x) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// 1 / cos^3 illuminates a plane evenly; it ends at 70 degrees.
float batwing(float vertical, float) {
  constexpr float kEdge = 1.0f;
  return fall(vertical, kEdge, 1.25f) * std::pow(std::cos(std::min(vertical, kEdge)), -3.0f);
}

// A batwing along the x axis that is narrow across it and leans towards +y.
float street(float vertical, float horizontal) {
  const float along = std::abs(std::cos(horizontal));
  const float towards = std::sin(horizontal);
  const float end = 0.55f + 0.65f * along + 0.25f * std::max(towards, 0.0f) - 0.2f * std::max(-towards, 0.0f);
  const float inner = std::min(vertical, end);
  return fall(vertical, end, end + 0.2f) * std::pow(std::cos(inner), -2.0f);
}

PhotometryProfile computed(size_t index) {
  switch (index) {
    case 1:
      return PhotometryProfile::sampled([](float vertical, float) { return std::max(std::cos(vertical), 0.0f); });
    case 2:
      return PhotometryProfile::sampled(batwing);
    case 3:
      return PhotometryProfile::sampled(street);
    default:
      return PhotometryProfile::sampled([](float, float) { return 1.0f; });
  }
}

Result<PhotometryProfile> profile_from(std::string_view source) {
  const auto known = std::ranges::find(kPhotometryProfiles, source, &Option::name);
  if (known != kPhotometryProfiles.end()) return computed(static_cast<size_t>(known - kPhotometryProfiles.begin()));
  return read_photometry(std::filesystem::path(source));
}

// Errors are not cached: the file may appear or be corrected.
Result<std::shared_ptr<const PhotometryProfile>> cached_profile(const std::string& source) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const PhotometryProfile>, std::less<>> profiles;
  const std::scoped_lock lock(mutex);
  auto& profile = profiles[source];
  if (!profile) {
    auto made = profile_from(source);
    if (!made) return made.error();
    profile = std::make_shared<const PhotometryProfile>(std::move(*made));
  }
  return profile;
}

}  // namespace

std::shared_ptr<const PhotometryProfile> photometry_profile(const std::string& source) {
  const auto profile = cached_profile(source);
  return profile ? *profile : *cached_profile(kPhotometryProfiles.front().name);
}

Result<void> accepts_photometry(std::string_view source) {
  const auto profile = cached_profile(std::string(source));
  if (!profile) return profile.error();
  return {};
}

}  // namespace etendue
