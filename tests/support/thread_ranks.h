// Ranks of a job as threads of one process.
#pragma once
#include <atomic>
#include <cstdlib>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "cluster/communicator.h"

namespace etendue::test {

// The messages between the ranks.
class Mailboxes {
 public:
  explicit Mailboxes(int ranks) : boxes_(static_cast<size_t>(ranks)) {}

  void put(int to, cluster::Message message) {
    const std::scoped_lock lock(mutex_);
    boxes_[static_cast<size_t>(to)].push_back(std::move(message));
  }
  std::optional<cluster::Message> take(int rank) {
    const std::scoped_lock lock(mutex_);
    auto& box = boxes_[static_cast<size_t>(rank)];
    if (box.empty()) return std::nullopt;
    cluster::Message message = std::move(box.front());
    box.pop_front();
    return message;
  }
  int size() const { return static_cast<int>(boxes_.size()); }

 private:
  std::mutex mutex_;
  std::vector<std::deque<cluster::Message>> boxes_;
};

class ThreadRank final : public cluster::Communicator {
 public:
  // Changes a message before it is sent; returns whether it is sent.
  using Fault = std::function<bool(std::vector<std::byte>&)>;

  ThreadRank(Mailboxes& boxes, int rank, Fault fault = {}) : boxes_(boxes), rank_(rank), fault_(std::move(fault)) {}

  int rank() const override { return rank_; }
  int size() const override { return boxes_.size(); }
  void send(int to, std::vector<std::byte> bytes) override {
    if (!fault_ || fault_(bytes)) boxes_.put(to, {rank_, std::move(bytes)});
  }
  std::optional<cluster::Message> receive() override { return boxes_.take(rank_); }
  void close() override {}
  [[noreturn]] void abort(int exit_code) override { std::_Exit(exit_code); }

 private:
  Mailboxes& boxes_;
  int rank_;
  Fault fault_;
};

}  // namespace etendue::test
