#include "window_user.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "file_drag.h"
#include "support/sanitizer.h"

namespace etendue::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Other tests may use all processors meanwhile; programs with sanitizers need many times as long.
constexpr int kPatience = kHasSanitizer ? 10 : 3;
constexpr auto kTimeout = kPatience * std::chrono::seconds(10);
constexpr auto kStartTimeout = kPatience * std::chrono::seconds(60);
constexpr auto kPoll = std::chrono::milliseconds(20);

bool is_installed(const char* program) {
  return std::system((std::string("command -v ") + program + " >/dev/null 2>&1").c_str()) == 0;
}

// The first line that a command prints.
std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  char line[256] = "";
  if (!pipe) return "";
  if (!fgets(line, sizeof line, pipe)) line[0] = '\0';
  pclose(pipe);
  std::string text(line);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

template <class Condition>
bool wait_for(std::chrono::milliseconds timeout, const Condition& condition) {
  for (const auto end = Clock::now() + timeout; Clock::now() < end; std::this_thread::sleep_for(kPoll))
    if (condition()) return true;
  return false;
}

// Xvfb chooses a free display and writes its number to a pipe.
pid_t start_server(std::string& display) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t server = fork();
  if (server == 0) {
    const std::string descriptor = std::to_string(ends[1]);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDERR_FILENO);
    execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "2560x1440x24", "-nolisten", "tcp",
           static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  char number[16] = "";
  const auto length = read(ends[0], number, sizeof number - 1);
  close(ends[0]);
  if (length <= 0) throw std::runtime_error("Xvfb does not start");
  display = ":" + std::to_string(std::atoi(number));
  return server;
}

std::string names_of_items(const WindowUser::json& report) {
  std::string names;
  for (const auto& item : report["items"].items()) names += " " + item.key();
  return names;
}

}  // namespace

bool WindowUser::is_possible() { return is_installed("Xvfb") && is_installed("xdotool"); }

WindowUser::WindowUser(const std::string& viewer, const fs::path& folder, const std::string& scene)
    : folder_(folder), report_file_(folder / "report.json") {
  const fs::path script = folder / "follow.json";
  std::ofstream(script) << json::array({{{"do", "follow"}, {"file", report_file_.string()}}}).dump();
  server_ = start_server(display_);
  viewer_ = fork();
  if (viewer_ == 0) {
    setenv("DISPLAY", display_.c_str(), 1);
    // The library of materials and the snapshots.
    setenv("HOME", folder.c_str(), 1);
    for (const char* name : {"XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CONFIG_HOME"}) unsetenv(name);
    if (chdir(folder.c_str()) != 0) _exit(126);
    execl(viewer.c_str(), viewer.c_str(), "view", scene.c_str(), "--script", script.c_str(), "--settings",
          (folder / "settings").c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  const bool started = wait_for(kStartTimeout, [&] { return !is_running() || fs::exists(report_file_); });
  if (!started || !is_running()) throw std::runtime_error("the viewer does not start");
  window_ = output_of("DISPLAY=" + display_ + " xdotool search --onlyvisible --name tendue");
  if (window_.empty()) throw std::runtime_error("there is no window");
  xdotool("windowfocus " + window_);
}

WindowUser::~WindowUser() {
  for (const pid_t process : {viewer_, server_}) {
    if (process <= 0) continue;
    kill(process, process == viewer_ ? SIGKILL : SIGTERM);
    waitpid(process, nullptr, 0);
  }
}

// The viewer may be writing the file, so reading is repeated until the text is complete.
WindowUser::json WindowUser::report() {
  json latest;
  const bool is_complete = wait_for(kTimeout, [&] {
    std::ifstream in(report_file_);
    latest = json::parse(in, nullptr, false);
    return latest.is_object() || !is_running();
  });
  if (!is_complete || !latest.is_object()) throw std::runtime_error("the viewer writes no state report");
  return latest;
}

bool WindowUser::wait_until(const std::function<bool(const json&)>& condition, double seconds) {
  return wait_for(std::chrono::milliseconds(static_cast<int64_t>(1000 * kPatience * seconds)), [&] {
    const json latest = report();
    return latest.is_object() && condition(latest);
  });
}

void WindowUser::settle() {
  constexpr auto kDelivery = std::chrono::milliseconds(50);  // of events by the display server
  std::this_thread::sleep_for(kDelivery);
  const int count = report().value("count", 0);
  wait_for(kTimeout, [&] {
    const json latest = report();
    return !is_running() || (latest.value("count", 0) >= count + 2 && latest.value("settled", false));
  });
}

bool WindowUser::has_item(const std::string& item) { return report()["items"].contains(item); }

// Panels change their layout when results arrive, so the placement has to stay the same for a moment.
WindowUser::json WindowUser::placement(const std::string& item) {
  constexpr auto kStable = std::chrono::milliseconds(250);
  json last;
  const bool is_stable = wait_for(kTimeout, [&] {
    std::this_thread::sleep_for(kStable);
    const json latest = report();
    if (!latest.is_object() || !latest["items"].contains(item)) return false;
    const bool is_same = latest["items"][item] == last;
    last = latest["items"][item];
    return is_same;
  });
  if (!is_stable) throw std::runtime_error("'" + item + "' is not on screen; there are" + names_of_items(report()));
  return last;
}

void WindowUser::xdotool(const std::string& arguments) {
  const std::string command = "DISPLAY=" + display_ + " xdotool " + arguments + " >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("xdotool " + arguments + " failed");
}

void WindowUser::move_to(const std::string& item) { move_in(item, 0.5, 0.5); }

void WindowUser::move_in(const std::string& item, double share_x, double share_y) {
  const json at = placement(item);
  move_to(static_cast<int>(at[0].get<double>() + share_x * at[2].get<double>()),
          static_cast<int>(at[1].get<double>() + share_y * at[3].get<double>()));
}

void WindowUser::click(const std::string& item, int button, int count) { click_in(item, 0.5, 0.5, button, count); }

void WindowUser::click_in(const std::string& item, double x, double y, int button, int count) {
  move_in(item, x, y);
  xdotool("click --repeat " + std::to_string(count) + " --delay 60 " + std::to_string(button));
  settle();
}

void WindowUser::drag_in(const std::string& item, double x, double y, int dx, int dy) {
  move_in(item, x, y);
  drag_from_pointer(dx, dy);
}

void WindowUser::drop(const std::vector<fs::path>& files) {
  drag_files(display_, std::stoul(window_), files);
  settle();
}

void WindowUser::move_to(int x, int y) {
  xdotool("mousemove --window " + window_ + " " + std::to_string(x) + " " + std::to_string(y));
}

void WindowUser::click_at(int x, int y) {
  xdotool("mousemove --window " + window_ + " " + std::to_string(x) + " " + std::to_string(y) + " click 1");
  settle();
}

void WindowUser::drag(const std::string& item, int dx, int dy) {
  move_to(item);
  drag_from_pointer(dx, dy);
}

void WindowUser::drag_at(int x, int y, int dx, int dy, int button) {
  move_to(x, y);
  drag_from_pointer(dx, dy, button);
}

// The viewer draws a frame between press, movements and release, however long its frames are.
void WindowUser::drag_from_pointer(int dx, int dy, int button) {
  const auto move_by = [&](int x, int y) {
    xdotool("mousemove_relative -- " + std::to_string(x) + " " + std::to_string(y));
    settle();
  };
  xdotool("mousedown " + std::to_string(button));
  settle();
  move_by(dx / 2, dy / 2);
  move_by(dx - dx / 2, dy - dy / 2);
  xdotool("mouseup " + std::to_string(button));
  settle();
}

void WindowUser::scroll(const std::string& item, int notches) {
  move_to(item);
  scroll_at_pointer(notches);
}

void WindowUser::scroll_at(int x, int y, int notches) {
  move_to(x, y);
  scroll_at_pointer(notches);
}

void WindowUser::scroll_at_pointer(int notches) {
  xdotool("click --repeat " + std::to_string(std::abs(notches)) + " " + (notches > 0 ? "4" : "5"));
  settle();
}

void WindowUser::hold(const std::string& key, const std::function<void()>& action) {
  xdotool("keydown " + key);
  action();
  xdotool("keyup " + key);
  settle();
}

void WindowUser::hold_button(int button, int x, int y, const std::function<void()>& action) {
  move_to(x, y);
  xdotool("mousedown " + std::to_string(button));
  settle();
  action();
  xdotool("mouseup " + std::to_string(button));
  settle();
}

void WindowUser::press(const std::string& keys) {
  xdotool("key --window 0 " + keys);
  settle();
}

void WindowUser::type(const std::string& text) {
  xdotool("type --window 0 --delay 15 -- '" + text + "'");
  settle();
}

void WindowUser::resize(int width, int height) {
  xdotool("windowsize " + window_ + " " + std::to_string(width) + " " + std::to_string(height));
  settle();
}

bool WindowUser::is_running() {
  if (viewer_ <= 0) return false;
  int status = 0;
  if (waitpid(viewer_, &status, WNOHANG) == 0) return true;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  viewer_ = -1;
  return false;
}

int WindowUser::wait_for_exit() {
  const bool ended = wait_for(kTimeout, [&] { return !is_running(); });
  return ended ? exit_code_ : -1;
}

}  // namespace etendue::test
