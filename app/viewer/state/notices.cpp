#include "viewer/state/notices.h"

#include <algorithm>
#include <ctime>
#include <utility>

namespace etendue::viewer {
namespace {

constexpr double kSecondsShown = 6;
constexpr double kSecondsPerCharacter = 0.05;  // long messages stay longer
constexpr size_t kMaxNotices = 5;
constexpr size_t kMaxLogEntries = 1000;

std::string local_time() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[16] = "";
  std::strftime(text, sizeof text, "%H:%M:%S", &local);
  return text;
}

}  // namespace

void Notices::record(const std::string& text, bool is_error) {
  if (is_error) last_error_ = text;
  if (log_.size() >= kMaxLogEntries) log_.erase(log_.begin());
  log_.push_back({local_time(), text, is_error});
}

void Notices::show(Notice notice) {
  notice.seconds_left = kSecondsShown + kSecondsPerCharacter * static_cast<double>(notice.text.size());
  const auto same = std::ranges::find(list_, notice.text, &Notice::text);
  if (same != list_.end()) {
    notice.count += same->count;
    list_.erase(same);
  }
  if (list_.size() >= kMaxNotices) list_.erase(list_.begin());
  list_.push_back(std::move(notice));
}

void Notices::add(Notice notice) {
  record(notice.text, notice.is_error);
  show(std::move(notice));
}

void Notices::add_warnings(const std::string& file, const std::vector<std::string>& warnings) {
  if (warnings.empty()) return;
  for (const auto& warning : warnings) record(file + ": " + warning, false);
  if (warnings.size() == 1) return show({.text = file + ": " + warnings.front()});
  show({.text = file + ": " + std::to_string(warnings.size()) + " warnings. " + warnings.front(), .has_more = true});
}

bool Notices::advance(double seconds) {
  bool any_message = false;
  for (auto& notice : list_) {
    if (notice.is_error) continue;
    notice.seconds_left -= seconds;
    any_message = true;
  }
  std::erase_if(list_, [](const Notice& n) { return n.seconds_left <= 0; });
  return any_message;
}

std::string Notices::take_error() { return std::exchange(last_error_, {}); }

}  // namespace etendue::viewer
