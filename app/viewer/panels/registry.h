// The list of all panels.
#pragma once
#include <memory>
#include <vector>

namespace etendue::viewer {

class Panel;

// Makes one instance of each panel, in the order of the tabs.
std::vector<std::unique_ptr<Panel>> make_panels();

}  // namespace etendue::viewer
