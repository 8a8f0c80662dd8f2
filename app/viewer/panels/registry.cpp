#include "viewer/panels/registry.h"

#include "viewer/panels/panel.h"

// All panels, in the order of their tabs. A new panel adds one line here: PANEL(name) calls make_name_panel().
#define ETENDUE_PANELS \
  PANEL(render)        \
  PANEL(scene)         \
  PANEL(material)      \
  PANEL(light)         \
  PANEL(camera)        \
  PANEL(display)       \
  PANEL(convergence)   \
  PANEL(histogram)     \
  PANEL(reliability)   \
  PANEL(paths)         \
  PANEL(techniques)    \
  PANEL(sampling)      \
  PANEL(trace)         \
  PANEL(radiosity)     \
  PANEL(surface)       \
  PANEL(lab)           \
  PANEL(sequence)      \
  PANEL(snapshots)     \
  PANEL(messages)

namespace etendue::viewer {

#define PANEL(name) std::unique_ptr<Panel> make_##name##_panel();
ETENDUE_PANELS
#undef PANEL

std::vector<std::unique_ptr<Panel>> make_panels() {
  std::vector<std::unique_ptr<Panel>> panels;
#define PANEL(name) panels.push_back(make_##name##_panel());
  ETENDUE_PANELS
#undef PANEL
  return panels;
}

}  // namespace etendue::viewer
