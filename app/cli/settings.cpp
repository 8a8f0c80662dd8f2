#include "settings.h"

#include "size.h"

namespace etendue::cli {

Result<void> set(render::Document& document, const std::string& name, const std::string& value) {
  auto changed = render::with_text(document, name, value);
  if (!changed) return changed.error();
  document = std::move(*changed);
  return {};
}

Result<void> set_size(render::Document& document, const std::string& text) {
  if (text.empty()) return {};
  const auto size = parse_size(text);
  if (!size) return size.error();
  if (auto r = set(document, "film.width", std::to_string(size->x)); !r) return r;
  return set(document, "film.height", std::to_string(size->y));
}

Result<void> set_environment(render::Document& document, const std::string& file) {
  if (file.empty()) return {};
  auto lit = render::with_environment(document, file);
  if (!lit) return lit.error();
  document = std::move(*lit);
  return {};
}

Result<void> set_all(render::Document& document, const std::vector<std::string>& assignments) {
  for (const auto& assignment : assignments) {
    const size_t equals = assignment.find('=');
    if (equals == std::string::npos) return usage_error("--set: '" + assignment + "' has no '='; give NAME=VALUE");
    if (auto r = set(document, assignment.substr(0, equals), assignment.substr(equals + 1)); !r) return r;
  }
  return {};
}

}  // namespace etendue::cli
