// Files that another program drags to a window and drops there, with the XDND protocol of X11.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace etendue::test {

// Whether the tests were built with Xlib.
bool can_drag_files();

// Drops the files in the middle of the window of a display (":1"). Throws std::runtime_error if the window does not
// accept them.
void drag_files(const std::string& display, unsigned long window, const std::vector<std::filesystem::path>& files);

}  // namespace etendue::test
