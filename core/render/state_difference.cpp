#include "render/state_difference.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

namespace etendue::render {
namespace {

using nlohmann::json;

constexpr const char* kSettings = "settings";
constexpr const char* kStructure = "structure";

json parsed_state(const std::string& text) {
  json state = json::parse(text, nullptr, false);
  const bool is_state = state.is_object() && state.contains(kSettings) && state[kSettings].is_object();
  return is_state ? state : json();
}

std::string text_of(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number_float()) return value.dump();
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value.get<double>());
  return text;
}

// Structural edits are compared completely, and shown by their number.
std::string structure_text(const json& edits) {
  return std::to_string(edits.size()) + (edits.size() == 1 ? " edit" : " edits");
}

std::string member_text(const json& object, const std::string& name, bool is_structure) {
  if (!object.contains(name)) return "";
  return is_structure ? structure_text(object[name]) : text_of(object[name]);
}

void compare(const json& a, const json& b, const std::string& name, std::vector<SettingDifference>& differences) {
  const bool in_a = a.contains(name), in_b = b.contains(name);
  if (in_a == in_b && (!in_a || a[name] == b[name])) return;
  const bool is_structure = name == kStructure;
  SettingDifference difference{name, member_text(a, name, is_structure), member_text(b, name, is_structure)};
  if (is_structure && difference.a == difference.b) difference.b += " of another kind";
  differences.push_back(std::move(difference));
}

}  // namespace

Result<std::vector<SettingDifference>> differences_of_states(const std::string& a, const std::string& b) {
  const json x = parsed_state(a), y = parsed_state(b);
  if (x.is_null() || y.is_null()) return input_error("these settings are not those of an image that etendue wrote");
  std::vector<SettingDifference> differences;
  for (const char* name : {"scene", "camera", "environment", kStructure}) compare(x, y, name, differences);
  std::set<std::string> names;
  for (const json* state : {&x, &y})
    for (const auto& [name, value] : (*state)[kSettings].items()) names.insert(name);
  for (const std::string& name : names) compare(x[kSettings], y[kSettings], name, differences);
  return differences;
}

bool same_settings(const std::string& a, const std::string& b) {
  json x = parsed_state(a), y = parsed_state(b);
  if (x.is_null() || y.is_null()) return false;
  x.erase("samples");
  y.erase("samples");
  return x == y;
}

uint32_t samples_of_state(const std::string& text) {
  const json state = parsed_state(text);
  const auto samples = state.is_null() ? state.end() : state.find("samples");
  return samples != state.end() && samples->is_number_unsigned() ? samples->get<uint32_t>() : 0;
}

}  // namespace etendue::render
