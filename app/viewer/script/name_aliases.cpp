#include "viewer/script/name_aliases.h"

namespace etendue::viewer {
namespace {

struct Alias {
  const char* former;
  const char* current;
};

constexpr Alias kAliases[] = {
    {"sheet.convergence", "panel.convergence"},
    {"sheet.health", "panel.reliability"},
    {"sheet.paths", "panel.paths"},
    {"sheet.techniques", "panel.techniques"},
    {"sheet.sampling", "panel.sampling"},
    {"sheet.surface", "panel.surface"},
    {"layout.drawer", "layout.bottom-panel"},
    {"status.health", "status.reliability"},
    {"view.health-map", "view.reliability-map"},
    {"compare.go-on", "compare.continue"},
    {"surface.keep", "surface.pin"},
    {"surface.drop", "surface.unpin"},
    {"surface.ball", "surface.preview"},
    {"surface.ball-kept", "surface.preview-pinned"},
    {"surface.lobe-kept", "surface.lobe-pinned"},
};

// Prefixes that were renamed.
constexpr Alias kPrefixes[] = {{"surface.badge.", "surface.check."}};

// Names that consist of a prefix and the name of an item or an action.
constexpr const char* kCompoundPrefixes[] = {"view.", "palette."};

}  // namespace

std::string current_name(const std::string& name) {
  for (const Alias& alias : kAliases)
    if (name == alias.former) return alias.current;
  for (const Alias& prefix : kPrefixes)
    if (name.starts_with(prefix.former)) return prefix.current + name.substr(std::string(prefix.former).size());
  for (const std::string prefix : kCompoundPrefixes)
    if (name.starts_with(prefix)) return prefix + current_name(name.substr(prefix.size()));
  return name;
}

}  // namespace etendue::viewer
