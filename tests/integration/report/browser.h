// A headless Chromium, driven through its debugging pipe: opens pages, evaluates expressions and sends real input
// events. Chrome DevTools Protocol 1.3; messages are JSON that ends in a zero byte.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace etendue::test {

class Browser {
 public:
  using json = nlohmann::json;

  // The path of Chromium; empty if it is not installed.
  static std::optional<std::string> program();

  // Starts a browser with its profile in `folder`. Throws std::runtime_error if it does not respond.
  Browser(const std::string& program, const std::filesystem::path& folder);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  // Loads a file with this fragment of the address and waits for the end of loading.
  void open(const std::filesystem::path& file, const std::string& fragment = "");
  void resize(int width, int height);
  void prefer(const std::string& color_scheme);

  // The value of an expression in the page. Waits for promises. Exceptions of the page are thrown as
  // std::runtime_error.
  json evaluate(const std::string& expression);

  void press(const std::string& key, int code);
  void drag(double from_x, double from_y, double to_x, double to_y);
  void move(double x, double y);

  // A PNG of a part of the window, in base64.
  std::string screenshot(double x, double y, double width, double height);

  // Errors and warnings since the page was loaded, and all requested addresses.
  const std::vector<std::string>& complaints() const { return complaints_; }
  const std::vector<std::string>& requests() const { return requests_; }

 private:
  json call(const std::string& method, const json& params = json::object());
  json next_message();
  void load(const std::string& address);
  void note(const json& event);
  void mouse(const std::string& type, double x, double y, int buttons);

  pid_t pid_ = -1;
  int to_ = -1, from_ = -1, last_id_ = 0;
  bool loaded_ = false;
  std::string session_, unread_;
  std::vector<std::string> complaints_, requests_;
};

}  // namespace etendue::test
