// The plugin for MPI: point-to-point messages that never block.
//
// A message is sent in chunks, because MPI counts bytes by `int`. The tag of a chunk shows whether it is the last one.
// Chunks are received into memory while other work goes on, so a rank that stops in the middle of a message does not
// stop the receiver.
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <list>
#include <memory>
#include <thread>
#include <utility>

#include "cluster/communicator.h"

namespace etendue::mpi {
namespace {

using cluster::Message;

constexpr size_t kLargestChunk = size_t{1} << 28;  // bytes
constexpr auto kLongestClosing = std::chrono::seconds(20);
constexpr int kMoreFollows = 1, kLastChunk = 2;  // tags

class MpiCommunicator final : public cluster::Communicator {
 public:
  MpiCommunicator() {
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    incoming_.resize(static_cast<size_t>(size_));
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void send(int to, std::vector<std::byte> bytes) override {
    Outgoing& out = outgoing_.emplace_back();
    out.bytes = std::move(bytes);
    for (size_t begin = 0; begin == 0 || begin < out.bytes.size(); begin += kLargestChunk) {
      const size_t count = std::min(kLargestChunk, out.bytes.size() - begin);
      const bool is_last = begin + count == out.bytes.size();
      MPI_Isend(out.bytes.data() + begin, static_cast<int>(count), MPI_BYTE, to, is_last ? kLastChunk : kMoreFollows,
                MPI_COMM_WORLD, &out.requests.emplace_back(MPI_REQUEST_NULL));
    }
    complete_sends();
  }

  std::optional<Message> receive() override {
    complete_sends();
    begin_receiving();
    for (int from = 0; from < size_; ++from)
      if (auto bytes = complete_message(incoming_[static_cast<size_t>(from)])) return Message{from, std::move(*bytes)};
    return std::nullopt;
  }

  // Messages that nobody needs any more are received until all ranks have sent theirs. If a rank has died, that does not
  // happen.
  void close() override {
    const auto start = std::chrono::steady_clock::now();
    const auto wait = [&] {
      if (std::chrono::steady_clock::now() - start > kLongestClosing) abort(1);
      discard_messages();
    };
    while (!outgoing_.empty()) wait();
    MPI_Request barrier = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &barrier);
    for (int done = 0; done == 0; MPI_Test(&barrier, &done, MPI_STATUS_IGNORE)) wait();
    MPI_Finalize();
  }

  [[noreturn]] void abort(int exit_code) override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }

 private:
  struct Outgoing {
    std::vector<std::byte> bytes;
    std::vector<MPI_Request> requests;
  };
  struct Chunk {
    std::vector<std::byte> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
    bool is_last = false;
  };
  // The chunks that have arrived or are being received from one rank.
  struct Incoming {
    std::deque<Chunk> chunks;
    std::vector<std::byte> begun;  // the first chunks of a message
  };

  void discard_messages() {
    while (receive()) {
    }
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }

  void complete_sends() {
    outgoing_.remove_if([](Outgoing& out) {
      int done = 0;
      MPI_Testall(static_cast<int>(out.requests.size()), out.requests.data(), &done, MPI_STATUSES_IGNORE);
      return done != 0;
    });
  }

  void begin_receiving() {
    while (true) {
      int is_there = 0, count = 0;
      MPI_Message message;
      MPI_Status status;
      MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &message, &status);
      if (is_there == 0) return;
      MPI_Get_count(&status, MPI_BYTE, &count);
      Chunk& chunk = incoming_[static_cast<size_t>(status.MPI_SOURCE)].chunks.emplace_back();
      chunk.bytes.resize(static_cast<size_t>(count));
      chunk.is_last = status.MPI_TAG == kLastChunk;
      MPI_Imrecv(chunk.bytes.data(), count, MPI_BYTE, &message, &chunk.request);
    }
  }

  static std::optional<std::vector<std::byte>> complete_message(Incoming& incoming) {
    while (!incoming.chunks.empty()) {
      Chunk& chunk = incoming.chunks.front();
      int done = 0;
      MPI_Test(&chunk.request, &done, MPI_STATUS_IGNORE);
      if (done == 0) return std::nullopt;
      if (incoming.begun.empty())
        incoming.begun = std::move(chunk.bytes);
      else
        incoming.begun.insert(incoming.begun.end(), chunk.bytes.begin(), chunk.bytes.end());
      const bool is_last = chunk.is_last;
      incoming.chunks.pop_front();
      if (is_last) return std::exchange(incoming.begun, {});
    }
    return std::nullopt;
  }

  int rank_ = 0, size_ = 1;
  std::list<Outgoing> outgoing_;
  std::vector<Incoming> incoming_;  // by rank
};

cluster::Communicator* join() {
  int provided = 0;
  // One thread at a time, which need not be the same: the viewer joins the job on its main thread.
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS) return nullptr;
  static MpiCommunicator communicator;
  return &communicator;
}

}  // namespace
}  // namespace etendue::mpi

extern "C" [[gnu::visibility("default")]] const void* etendue_mpi_plugin(int version) {
  static const etendue::cluster::JoinJob join_job = etendue::mpi::join;
  return version == etendue::cluster::kMpiPluginVersion ? static_cast<const void*>(&join_job) : nullptr;
}
