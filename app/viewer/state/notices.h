// Messages in the corner of the viewport. Information disappears after some seconds; errors stay until they are closed.
#pragma once
#include <string>
#include <vector>

namespace etendue::viewer {

class Notices {
 public:
  struct Notice {
    std::string text;
    bool is_error = false;
    double seconds_left = 0;
  };

  void add_message(std::string text) { add(std::move(text), false); }
  void add_error(std::string text) { add(std::move(text), true); }
  const std::vector<Notice>& all() const { return list_; }
  void close(size_t index) { list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(index)); }
  // Removes messages whose time is over. Returns true while there are messages that will disappear.
  bool advance(double seconds);
  // The newest error that was not taken before, or an empty string. Steps of scripts fail with it.
  std::string take_error();

 private:
  void add(std::string text, bool is_error);

  std::vector<Notice> list_;
  std::string last_error_;
};

}  // namespace etendue::viewer
