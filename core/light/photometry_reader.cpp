#include "light/photometry_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/file.h"

namespace etendue {
namespace {

constexpr int kMaxAngles = 1000;
constexpr float kRadians = kPi / 180;
constexpr double kLargestIntensity = 1e9;  // cd
constexpr float kLargestTiltFactor = 10;

bool is_separator(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ','; }

std::string_view without_spaces(std::string_view text) {
  while (!text.empty() && is_separator(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_separator(text.back())) text.remove_suffix(1);
  return text;
}

// Angles of files are rounded.
bool is_about(float angle, float expected) { return std::abs(angle - expected) < 0.01f; }

std::string number_text(float x) {
  std::string text = std::to_string(x);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

}  // namespace

Error PhotometryReader::error(const std::string& what) const {
  return input_error(name_ + ": line " + std::to_string(line_) + ": " + what);
}

std::string_view PhotometryReader::next_line() {
  // A line end counts when the next line is read: until then, errors are in the line before it.
  if (at_ > 0 && at_ < text_.size() && text_[at_] == '\n') {
    ++at_;
    ++line_;
  }
  const size_t end = std::min(text_.find('\n', at_), text_.size());
  const std::string_view line = text_.substr(at_, end - at_);
  at_ = end;
  return line;
}

std::string_view PhotometryReader::next_word() {
  while (at_ < text_.size() && is_separator(text_[at_])) {
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }
  const size_t first = at_;
  while (at_ < text_.size() && !is_separator(text_[at_])) ++at_;
  return text_.substr(first, at_ - first);
}

Result<double> PhotometryReader::number(const char* what) {
  std::string_view word = next_word();
  if (word.empty()) return error(std::string("the file ends before ") + what);
  const std::string_view shown = word.substr(0, 40);
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    return error("'" + std::string(shown) + "' is not a number; expected " + what);
  return value;
}

Result<int> PhotometryReader::count(const char* what, int largest) {
  const auto value = number(what);
  if (!value) return value.error();
  if (*value != std::floor(*value) || *value < 1 || *value > largest)
    return error(std::string(what) + " has to be a whole number from 1 to " + std::to_string(largest));
  return static_cast<int>(*value);
}

Result<std::vector<float>> PhotometryReader::angles(int count, const char* what) {
  std::vector<float> list;
  for (int i = 0; i < count; ++i) {
    const auto angle = number(what);
    if (!angle) return angle.error();
    if (std::abs(*angle) > 360) return error(std::string(what) + " has to be between -360 and 360 degrees");
    if (!list.empty() && !(static_cast<float>(*angle) > list.back()))
      return error(std::string(what) + " has to be larger than the one before it");
    list.push_back(static_cast<float>(*angle));
  }
  return list;
}

// Files of 1995 and later name their standard with a colon. Later standards reserve the photometric factor.
Result<void> PhotometryReader::read_header() {
  has_photometric_factor_ = !text_.starts_with("IESNA:") && !text_.starts_with("IES:");
  while (at_ < text_.size()) {
    const std::string_view line = next_line();
    if (!line.starts_with("TILT")) continue;
    const size_t equals = line.find('=');
    if (equals == std::string_view::npos) return error("TILT has to be followed by = and NONE, INCLUDE or a file name");
    const std::string_view value = without_spaces(line.substr(equals + 1));
    if (value == "NONE") return {};
    return value == "INCLUDE" ? read_tilt() : read_tilt_file(value);
  }
  return input_error(name_ + ": has no line that starts with TILT=; a photometric file of IES LM-63 is expected");
}

Result<void> PhotometryReader::read_tilt() {
  if (auto geometry = count("the position of the source in the luminaire", 3); !geometry) return geometry.error();
  const auto pairs = count("the number of tilt angles", kMaxAngles);
  if (!pairs) return pairs.error();
  auto degrees = angles(*pairs, "a tilt angle");
  if (!degrees) return degrees.error();
  for (const float angle : *degrees) tilt_angles_.push_back(angle * kRadians);
  for (int i = 0; i < *pairs; ++i) {
    const auto factor = number("a tilt multiplier");
    if (!factor) return factor.error();
    if (!(*factor >= 0 && *factor <= kLargestTiltFactor))
      return error("a tilt multiplier has to be between 0 and " + number_text(kLargestTiltFactor));
    tilt_factors_.push_back(static_cast<float>(*factor));
  }
  return {};
}

Result<void> PhotometryReader::read_tilt_file(std::string_view file) {
  const std::filesystem::path path = folder_ / std::filesystem::path(file).filename();
  const auto bytes = read_file(path);
  if (!bytes)
    return error("the file '" + std::string(file) +
                 "' with the TILT data cannot be read; put it beside this file, or write TILT=NONE");
  const std::string name = path.string();
  PhotometryReader reader({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, name, folder_);
  if (auto ok = reader.read_tilt(); !ok) return ok.error();
  tilt_angles_ = std::move(reader.tilt_angles_);
  tilt_factors_ = std::move(reader.tilt_factors_);
  return {};
}

Result<PhotometryProfile> PhotometryReader::read() {
  if (auto ok = read_header(); !ok) return ok.error();
  double multiplier = 1;
  for (const char* what : {"the number of light sources", "the lumens per source", "the candela multiplier"}) {
    const auto value = number(what);
    if (!value) return value.error();
    multiplier = *value;
  }
  const auto vertical_count = count("the number of vertical angles", kMaxAngles);
  if (!vertical_count) return vertical_count.error();
  const auto horizontal_count = count("the number of horizontal angles", kMaxAngles);
  if (!horizontal_count) return horizontal_count.error();
  const auto type = count("the photometric type (1 is C, 2 is B, 3 is A)", 3);
  if (!type) return type.error();
  for (const char* what : {"the unit of lengths", "the width", "the length", "the height"})
    if (auto value = number(what); !value) return value.error();
  const auto ballast = number("the ballast factor");
  if (!ballast) return ballast.error();
  const auto photometric_factor = number("the photometric factor (1 in files of 1995 and later)");
  if (!photometric_factor) return photometric_factor.error();
  if (auto value = number("the input watts"); !value) return value.error();
  const double scale = multiplier * *ballast * (has_photometric_factor_ ? *photometric_factor : 1);
  if (!(scale > 0)) return error("the candela multiplier and the ballast factors have to be positive");

  if (*vertical_count < 2) return error("there has to be more than one vertical angle");
  const auto vertical = angles(*vertical_count, "a vertical angle");
  if (!vertical) return vertical.error();
  const auto horizontal = angles(*horizontal_count, "a horizontal angle");
  if (!horizontal) return horizontal.error();
  std::vector<float> values;
  for (int i = 0; i < *vertical_count * *horizontal_count; ++i) {
    const auto value = number("a candela value");
    if (!value) return value.error();
    if (*value < 0 || *value * scale > kLargestIntensity)
      return error("a candela value has to be between 0 and 1e9, including the multiplier");
    values.push_back(static_cast<float>(*value * scale));
  }

  const auto profile_of = [&](Grid grid) {
    PhotometryProfile profile(static_cast<Type>(*type), std::move(grid.polar), std::move(grid.azimuths),
                              std::move(grid.values));
    profile.tilt_angles_ = std::move(tilt_angles_);
    profile.tilt_factors_ = std::move(tilt_factors_);
    return profile;
  };
  if (static_cast<Type>(*type) == Type::c) {
    auto grid = grid_of_type_c(*vertical, *horizontal, values);
    if (!grid) return grid.error();
    return profile_of(std::move(*grid));
  }
  if (*horizontal_count < 2) return error("photometry of types A and B needs more than one horizontal angle");
  for (const auto* list : {&*vertical, &*horizontal})
    if (list->front() < -90.01f || list->back() > 90.01f)
      return error("angles of types A and B have to be between -90 and 90 degrees");
  return profile_of(static_cast<Type>(*type) == Type::b ? grid_of_type_b(*vertical, *horizontal, values)
                                                        : grid_of_type_a(*vertical, *horizontal, values));
}

// One horizontal angle: axial symmetry. 0 to 90: both planes are planes of symmetry. 0 to 180 and 90 to 270: one is.
Result<PhotometryReader::Grid> PhotometryReader::grid_of_type_c(const std::vector<float>& vertical,
                                                                const std::vector<float>& horizontal,
                                                                const std::vector<float>& values) const {
  if (vertical.front() < -0.01f || vertical.back() > 180.01f)
    return error("vertical angles of type C have to be between 0 and 180 degrees");
  std::vector<std::pair<float, size_t>> planes;  // angle and row of the file
  for (size_t i = 0; i < horizontal.size(); ++i) planes.emplace_back(horizontal[i], i);
  const auto mirror_at = [&](float angle) {
    for (size_t i = planes.size() - 1; i-- > 0;) planes.emplace_back(2 * angle - planes[i].first, planes[i].second);
  };
  const float first = horizontal.front(), last = horizontal.back();
  if (horizontal.size() == 1) {
    planes = {{0.0f, 0}, {360.0f, 0}};
  } else if (is_about(first, 0) && is_about(last, 90)) {
    mirror_at(last);
    mirror_at(planes.back().first);
  } else if ((is_about(first, 0) && is_about(last, 180)) || (is_about(first, 90) && is_about(last, 270))) {
    mirror_at(last);
  } else if (!(is_about(first, 0) && is_about(last, 360))) {
    return error(
        "horizontal angles of type C have to go from 0 to 0, 90, 180 or 360 degrees, or from 90 to 270; they go "
        "from " +
        number_text(first) + " to " + number_text(last));
  }
  Grid grid;
  for (const float v : vertical) grid.polar.push_back(std::clamp(v, 0.0f, 180.0f) * kRadians);
  for (const auto& [angle, row] : planes) {
    grid.azimuths.push_back(angle * kRadians);
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * vertical.size());
    grid.values.insert(grid.values.end(), begin, begin + static_cast<std::ptrdiff_t>(vertical.size()));
  }
  return grid;
}

// The polar angle is that to the x axis: 90 degrees less the horizontal angle. Horizontal angles from 0 on are
// symmetric.
PhotometryReader::Grid PhotometryReader::grid_of_type_b(std::vector<float> vertical,
                                                        const std::vector<float>& horizontal,
                                                        const std::vector<float>& values) const {
  const size_t rows = horizontal.size();
  std::vector<std::pair<float, size_t>> columns;  // polar angle in degrees and row of the file
  for (size_t i = rows; i-- > 0;) columns.emplace_back(90 - horizontal[i], i);
  if (is_about(horizontal.front(), 0))
    for (size_t i = 1; i < rows; ++i) columns.emplace_back(90 + horizontal[i], i);
  Grid grid;
  for (const auto& [angle, row] : columns) grid.polar.push_back(std::clamp(angle, 0.0f, 180.0f) * kRadians);
  for (size_t v = 0; v < vertical.size(); ++v) {
    grid.azimuths.push_back(vertical[v] * kRadians);
    for (const auto& [angle, row] : columns) grid.values.push_back(values[row * vertical.size() + v]);
  }
  return grid;
}

// The polar angle is that to the y axis: 90 degrees less the vertical angle. Horizontal angles from 0 on are symmetric.
PhotometryReader::Grid PhotometryReader::grid_of_type_a(const std::vector<float>& vertical,
                                                        const std::vector<float>& horizontal,
                                                        const std::vector<float>& values) const {
  std::vector<std::pair<float, size_t>> planes;
  if (is_about(horizontal.front(), 0))
    for (size_t i = horizontal.size() - 1; i > 0; --i) planes.emplace_back(-horizontal[i], i);
  for (size_t i = 0; i < horizontal.size(); ++i) planes.emplace_back(horizontal[i], i);
  Grid grid;
  for (size_t v = vertical.size(); v-- > 0;)
    grid.polar.push_back(std::clamp(90 - vertical[v], 0.0f, 180.0f) * kRadians);
  for (const auto& [angle, row] : planes) {
    grid.azimuths.push_back(angle * kRadians);
    for (size_t v = vertical.size(); v-- > 0;) grid.values.push_back(values[row * vertical.size() + v]);
  }
  return grid;
}

Result<PhotometryProfile> parse_photometry(std::string_view text, const std::string& name,
                                           const std::filesystem::path& folder) {
  return PhotometryReader(text, name, folder).read();
}

Result<PhotometryProfile> read_photometry(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return parse_photometry({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string(),
                          path.parent_path());
}

}  // namespace etendue
