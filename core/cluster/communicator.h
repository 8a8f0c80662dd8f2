// Messages between the processes (ranks) of one job
//
// Implementations: core/mpi for jobs that mpirun has started, and one of the tests within a process.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace etendue::cluster {

struct Message {
  int from = 0;
  std::vector<std::byte> bytes;
};

// Functions return at once unless stated otherwise. They are called from one thread at a time.
class Communicator {
 public:
  virtual int rank() const = 0;
  virtual int size() const = 0;
  // Messages from one rank to another arrive in the order in which they are sent. `send` and `receive` also advance the
  // transfers in progress.
  virtual void send(int to, std::vector<std::byte> bytes) = 0;
  // The next message that has arrived completely, if there is one.
  virtual std::optional<Message> receive() = 0;
  // Waits until all ranks have called this function, or ends the process if that takes long. Nothing can be sent
  // afterwards.
  virtual void close() = 0;
  // Ends all ranks and this process without waiting for ranks that do not answer. Does not return.
  [[noreturn]] virtual void abort(int exit_code) = 0;

 protected:
  ~Communicator() = default;
};

// Increase it with every change of this file.
inline constexpr int kMpiPluginVersion = 1;

// The plugin exports `const void* etendue_mpi_plugin(int version)` (base/load_plugin.h), whose result points to a
// function of this type. The function joins the job and returns null if that fails.
using JoinJob = Communicator* (*)();
inline constexpr const char* kGetMpiPlugin = "etendue_mpi_plugin";

}  // namespace etendue::cluster
