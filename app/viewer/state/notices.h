// Lines that tell the user what happened, where they look, and go away by themselves; errors stay until they are
// closed.
#pragma once
#include <string>
#include <vector>

namespace etendue::viewer {

class Notices {
 public:
  void say(std::string text) { add(std::move(text), false); }
  void complain(std::string text) { add(std::move(text), true); }

  struct Notice {
    std::string text;
    bool error;
    double seconds_left;
  };
  const std::vector<Notice>& all() const { return list_; }
  void close(size_t index) { list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(index)); }
  // True while a line will go away by itself.
  bool pass(double seconds);
  // The newest error that `take_error` has not given yet; scripts fail by it.
  std::string take_error();

 private:
  void add(std::string text, bool error);
  std::vector<Notice> list_;
  std::string error_;
};

}  // namespace etendue::viewer
