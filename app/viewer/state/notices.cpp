#include "viewer/state/notices.h"

#include <utility>

namespace etendue::viewer {
namespace {

constexpr double kSecondsShown = 6;
constexpr size_t kMaxNotices = 5;

}  // namespace

void Notices::add(std::string text, bool is_error) {
  if (is_error) last_error_ = text;
  if (list_.size() >= kMaxNotices) list_.erase(list_.begin());
  list_.push_back({std::move(text), is_error, kSecondsShown});
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
