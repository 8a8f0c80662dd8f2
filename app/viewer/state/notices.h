// Messages in the corner of the viewport, and a log of all of them. Information disappears after some seconds; errors
// stay until they are closed or another file is opened.
#pragma once
#include <string>
#include <vector>

namespace etendue::viewer {

class Notices {
 public:
  struct Notice {
    std::string text;
    bool is_error = false;
    bool has_more = false;  // the log has the rest of these messages
    std::string panel{};    // that the button "Change..." opens; empty: there is no button
    int count = 1;          // how often the text was added
    double seconds_left = 0;
  };
  struct LogEntry {
    std::string time;  // "23:59:59", local
    std::string text;
    bool is_error = false;
  };

  void add_message(const std::string& text) { add({.text = text}); }
  // A message about something that can be changed in a panel.
  void add_message(const std::string& text, const std::string& panel) { add({.text = text, .panel = panel}); }
  void add_error(const std::string& text) { add({.text = text, .is_error = true}); }
  // Warnings about one file: a single notice with their number and the first of them. The log has all.
  void add_warnings(const std::string& file, const std::vector<std::string>& warnings);

  const std::vector<Notice>& all() const { return list_; }
  void close(size_t index) { list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(index)); }
  void close_all() { list_.clear(); }
  // Removes messages whose time is over. Returns true while there are messages that will disappear.
  bool advance(double seconds);

  // Oldest first.
  const std::vector<LogEntry>& log() const { return log_; }
  void clear_log() { log_.clear(); }

  // The newest error that was not taken before, or an empty string. Steps of scripts fail with it.
  std::string take_error();

 private:
  void add(Notice notice);
  void show(Notice notice);
  void record(const std::string& text, bool is_error);

  std::vector<Notice> list_;
  std::vector<LogEntry> log_;
  std::string last_error_;
};

}  // namespace etendue::viewer
