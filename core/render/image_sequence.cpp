#include "render/image_sequence.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "geometry/mesh.h"
#include "scene/compiled_scene.h"

namespace etendue::render {
namespace {

std::optional<uint32_t> parse_number(std::string_view text) {
  uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number > kMaxFrames) return std::nullopt;
  return number;
}

}  // namespace

Result<FrameRange> parse_frames(const std::string& text) {
  const size_t colon = text.find(':');
  const auto first = colon == std::string::npos ? std::optional<uint32_t>(0) : parse_number(text.substr(0, colon));
  const auto end = parse_number(colon == std::string::npos ? text : text.substr(colon + 1));
  if (first && end && *first < *end) return FrameRange{*first, *end};
  return usage_error("'" + text + "' is not a range of frames; give A:B with 0 <= A < B <= " + std::to_string(kMaxFrames) +
                     ", or their number");
}

Result<Document> animation_frame(const Document& document, uint32_t frame, double frames_per_second) {
  return with(document, "scene.time", static_cast<double>(frame) / frames_per_second);
}

Document turned_about(const Document& document, const Vec3& centre, double angle) {
  Document turned = document;
  // In double precision, so that a turn of 90 degrees leaves no rounding errors that depend on the position.
  const glm::dvec3 c(centre);
  glm::dmat4 turn = glm::rotate(glm::translate(glm::dmat4(1), c), angle, glm::dvec3(0, 1, 0));
  turn = glm::translate(turn, -c);
  turned.camera.to_world = Mat4(turn * glm::dmat4(document.camera.to_world));
  return turned;
}

Vec3 orbit_centre(const Camera& camera, const scene::CompiledScene& scene) {
  const Bounds& bounds = scene.bounds();
  const Ray axis{Vec3(camera.to_world[3]), 0, -Vec3(camera.to_world[2]), kInfinity};
  const Hit hit = scene.intersect(axis, 0);
  const float to_centre = bounds.empty() ? camera.focus_distance : glm::dot(bounds.center() - axis.origin, axis.direction);
  const float distance = hit ? hit.t : std::max(to_centre, 0.1f * std::max(bounds.radius(), 1e-3f));
  return axis.origin + axis.direction * distance;
}

ImageSequence::ImageSequence(Document document, const SequencePlan& plan)
    : document_(std::move(document)), plan_(plan) {
  if (!plan.is_turntable) return;
  const auto compiled = scene::compile(document_.scene, document_.camera, nullptr, document_.height);
  centre_ = orbit_centre(document_.camera, *compiled);
}

Result<Document> ImageSequence::at(uint32_t frame) const {
  if (!plan_.is_turntable) return animation_frame(document_, frame, plan_.frames_per_second);
  return turned_about(document_, centre_, 2 * std::numbers::pi * frame / plan_.frames.end);
}

std::string frame_file(const std::string& pattern, uint32_t number) {
  const size_t name = pattern.find_last_of('/') + 1;  // 0 without a folder
  const std::string digits = std::to_string(number);
  const auto padded = [&](size_t width) {
    return std::string(width > digits.size() ? width - digits.size() : 0, '0') + digits;
  };
  const size_t last = pattern.find_last_of('#');
  if (last != std::string::npos && last >= name) {
    size_t first = last;
    while (first > name && pattern[first - 1] == '#') --first;
    return pattern.substr(0, first) + padded(last + 1 - first) + pattern.substr(last + 1);
  }
  const size_t dot = pattern.find_last_of('.');
  const size_t end = dot == std::string::npos || dot < name ? pattern.size() : dot;
  return pattern.substr(0, end) + "." + padded(4) + pattern.substr(end);
}

}  // namespace etendue::render
