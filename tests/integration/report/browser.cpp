#include "integration/report/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace etendue::test {
namespace {

namespace fs = std::filesystem;

constexpr int kTimeout = 60'000;  // in milliseconds; the machine may be busy

// Chromium reads commands from descriptor 3 and writes answers to 4. Does not return.
[[noreturn]] void run_program(const std::string& program, const fs::path& profile, int commands, int answers) {
  // Moves both descriptors away from 3 and 4 first.
  const int in = ::fcntl(commands, F_DUPFD, 10), out = ::fcntl(answers, F_DUPFD, 10);
  ::dup2(in, 3), ::dup2(out, 4);
  const int nowhere = ::open("/dev/null", O_RDWR);
  ::dup2(nowhere, 1), ::dup2(nowhere, 2);
  const std::string data = "--user-data-dir=" + profile.string();
  ::execl(program.c_str(), program.c_str(), "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
          "--no-first-run", "--disable-background-networking", "--remote-debugging-pipe", data.c_str(), "about:blank",
          nullptr);
  ::_exit(127);
}

}  // namespace

std::optional<std::string> Browser::program() {
  const char* path = std::getenv("PATH");
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
      if (::access((folder + "/" + name).c_str(), X_OK) == 0) return folder + "/" + name;
  }
  return {};
}

Browser::Browser(const std::string& program, const fs::path& folder) {
  ::signal(SIGPIPE, SIG_IGN);
  std::array<int, 2> commands{}, answers{};
  if (::pipe2(commands.data(), O_CLOEXEC) != 0 || ::pipe2(answers.data(), O_CLOEXEC) != 0)
    throw std::runtime_error("no pipe");
  pid_ = ::fork();
  if (pid_ == 0) run_program(program, folder / "profile", commands[0], answers[1]);
  ::close(commands[0]), ::close(answers[1]);
  to_ = commands[1];
  from_ = answers[0];
  const json target = call("Target.createTarget", {{"url", "about:blank"}});
  const json attached = call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}});
  session_ = attached.at("sessionId").get<std::string>();
  for (const char* domain : {"Page", "Runtime", "Log", "Network"}) call(std::string(domain) + ".enable");
}

Browser::~Browser() {
  ::close(to_), ::close(from_);
  ::kill(pid_, SIGTERM);
  ::waitpid(pid_, nullptr, 0);
}

void Browser::open(const fs::path& file, const std::string& fragment) {
  // Loads an empty page first: another fragment of the same page would not reload it.
  load("about:blank");
  complaints_.clear();
  requests_.clear();
  load("file://" + file.string() + fragment);
}

void Browser::load(const std::string& address) {
  loaded_ = false;
  call("Page.navigate", {{"url", address}});
  while (!loaded_) note(next_message());
}

void Browser::resize(int width, int height) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void Browser::prefer(const std::string& color_scheme) {
  const json feature{{"name", "prefers-color-scheme"}, {"value", color_scheme}};
  call("Emulation.setEmulatedMedia", {{"features", json::array({feature})}});
}

Browser::json Browser::evaluate(const std::string& expression) {
  const json answer =
      call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
  if (answer.contains("exceptionDetails")) throw std::runtime_error(answer["exceptionDetails"].dump());
  return answer["result"].value("value", json());
}

void Browser::press(const std::string& key, int code) {
  for (const char* type : {"rawKeyDown", "keyUp"})
    call("Input.dispatchKeyEvent", {{"type", type}, {"key", key}, {"code", key}, {"windowsVirtualKeyCode", code}});
}

void Browser::mouse(const std::string& type, double x, double y, int buttons) {
  call("Input.dispatchMouseEvent", {{"type", type},
                                    {"x", x},
                                    {"y", y},
                                    {"button", type == "mouseMoved" ? "none" : "left"},
                                    {"buttons", buttons},
                                    {"clickCount", 1}});
}

void Browser::move(double x, double y) { mouse("mouseMoved", x, y, 0); }

void Browser::drag(double from_x, double from_y, double to_x, double to_y) {
  mouse("mousePressed", from_x, from_y, 1);
  mouse("mouseMoved", to_x, to_y, 1);
  mouse("mouseReleased", to_x, to_y, 0);
}

std::string Browser::screenshot(double x, double y, double width, double height) {
  const json clip{{"x", x}, {"y", y}, {"width", width}, {"height", height}, {"scale", 1}};
  return call("Page.captureScreenshot", {{"clip", clip}, {"captureBeyondViewport", true}}).at("data");
}

Browser::json Browser::call(const std::string& method, const json& params) {
  json message{{"id", ++last_id_}, {"method", method}, {"params", params}};
  if (!session_.empty()) message["sessionId"] = session_;
  const std::string text = message.dump();
  if (::write(to_, text.c_str(), text.size() + 1) != static_cast<ssize_t>(text.size()) + 1)
    throw std::runtime_error("the browser is gone");
  while (true) {
    const json answer = next_message();
    if (answer.value("id", 0) != last_id_) {
      note(answer);
      continue;
    }
    if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
    return answer.value("result", json::object());
  }
}

Browser::json Browser::next_message() {
  size_t end = 0;
  while ((end = unread_.find('\0')) == std::string::npos) {
    pollfd wait{from_, POLLIN, 0};
    if (::poll(&wait, 1, kTimeout) <= 0) throw std::runtime_error("the browser does not answer");
    std::array<char, 65536> some{};
    const ssize_t n = ::read(from_, some.data(), some.size());
    if (n <= 0) throw std::runtime_error("the browser is gone");
    unread_.append(some.data(), static_cast<size_t>(n));
  }
  const json message = json::parse(unread_.substr(0, end));
  unread_.erase(0, end + 1);
  return message;
}

void Browser::note(const json& event) {
  const std::string method = event.value("method", "");
  const bool complaint =
      method == "Runtime.consoleAPICalled" || method == "Runtime.exceptionThrown" || method == "Log.entryAdded";
  if (complaint) complaints_.push_back(event["params"].dump());
  if (method == "Network.requestWillBeSent") requests_.push_back(event["params"]["request"]["url"]);
  if (method == "Page.loadEventFired") loaded_ = true;
}

}  // namespace etendue::test
