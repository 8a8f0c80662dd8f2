#include "viewer/state/notices.h"

#include <utility>

namespace etendue::viewer {
namespace {

constexpr double kSecondsShown = 6;
constexpr size_t kMostShown = 5;

}  // namespace

void Notices::add(std::string text, bool error) {
  if (error) error_ = text;
  if (list_.size() >= kMostShown) list_.erase(list_.begin());
  list_.push_back({std::move(text), error, kSecondsShown});
}

bool Notices::pass(double seconds) {
  bool passing = false;
  for (auto& notice : list_)
    if (!notice.error) notice.seconds_left -= seconds, passing = true;
  std::erase_if(list_, [](const Notice& n) { return n.seconds_left <= 0; });
  return passing;
}

std::string Notices::take_error() { return std::exchange(error_, {}); }

}  // namespace etendue::viewer
