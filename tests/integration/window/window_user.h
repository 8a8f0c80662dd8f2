// A user of the viewer in a window on a virtual display: moves a real pointer and presses real keys with xdotool. The
// positions of items come from the viewer, which writes them to a file (the script step "follow").
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace etendue::test {

class WindowUser {
 public:
  using json = nlohmann::json;

  // Whether Xvfb and xdotool are installed.
  static bool is_possible();

  // Starts a virtual display and the viewer with a scene. Throws std::runtime_error if no window appears.
  WindowUser(const std::string& viewer, const std::filesystem::path& folder, const std::string& scene);
  ~WindowUser();
  WindowUser(const WindowUser&) = delete;
  WindowUser& operator=(const WindowUser&) = delete;

  // The latest state report, with the placements of all items as [x, y, width, height]. Throws std::runtime_error if
  // there is none within the time limit, or if the viewer has ended.
  json report();
  // Waits until a report fulfils a condition; returns false after this time or if the viewer has ended.
  bool wait_until(const std::function<bool(const json&)>& condition, double seconds = 10);
  // Waits until the viewer has handled all events and has drawn some frames after them.
  void settle();
  bool has_item(const std::string& item);

  // The pointer moves to the centre of the item; throws std::runtime_error if it does not appear on screen.
  void move_to(const std::string& item);
  // A position of the window in pixels.
  void click_at(int x, int y);
  void click(const std::string& item, int button = 1, int count = 1);
  // A position relative to the upper left corner of the item, in shares of its size.
  void click_in(const std::string& item, double x, double y, int button = 1, int count = 1);
  void drag_in(const std::string& item, double x, double y, int dx, int dy);
  void drag(const std::string& item, int dx, int dy);
  void drag_at(int x, int y, int dx, int dy, int button = 1);
  void scroll(const std::string& item, int notches);
  void scroll_at(int x, int y, int notches);
  void hold(const std::string& key, const std::function<void()>& action);
  void hold_button(int button, int x, int y, const std::function<void()>& action);
  void press(const std::string& keys);  // "ctrl+a" in the notation of xdotool
  void type(const std::string& text);
  void resize(int width, int height);
  // Another program drops files on the window. Throws std::runtime_error if it does not take them.
  void drop(const std::vector<std::filesystem::path>& files);

  bool is_running();
  // Waits for the end of the viewer and returns its exit code; -1 if it crashed or has not ended after ten seconds.
  int wait_for_exit();

 private:
  void xdotool(const std::string& arguments);
  json placement(const std::string& item);
  void move_in(const std::string& item, double x, double y);
  void move_to(int x, int y);
  void scroll_at_pointer(int notches);
  void drag_from_pointer(int dx, int dy, int button = 1);

  std::filesystem::path folder_;
  std::filesystem::path report_file_;
  std::string display_;
  std::string window_;
  pid_t server_ = -1;
  pid_t viewer_ = -1;
  int exit_code_ = -1;
};

}  // namespace etendue::test
