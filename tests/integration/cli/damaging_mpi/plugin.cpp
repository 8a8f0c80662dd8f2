// A plugin for tests: that of MPI, but the last rank changes the messages that it sends. ETENDUE_TEST_FAULT says which:
//
//   results    every large message is damaged
//   version    the rank reports another version of the program
//
// The program loads it in place of the real one if ETENDUE_PLUGIN_PATH names its folder. ETENDUE_MPI_PLUGIN is the path
// of the real one.
#include <dlfcn.h>

#include <cstdlib>
#include <string>
#include <utility>

#include "cluster/communicator.h"

namespace etendue::test {
namespace {

constexpr std::byte kReady{2};            // cluster::MessageKind::ready
constexpr size_t kLargeMessage = 10'000;  // bytes; results of pieces are larger, other messages of workers smaller

class DamagingRank final : public cluster::Communicator {
 public:
  explicit DamagingRank(cluster::Communicator& mpi) : mpi_(mpi) {}

  int rank() const override { return mpi_.rank(); }
  int size() const override { return mpi_.size(); }
  void send(int to, std::vector<std::byte> bytes) override {
    if (rank() + 1 == size()) change(bytes);
    mpi_.send(to, std::move(bytes));
  }
  std::optional<cluster::Message> receive() override { return mpi_.receive(); }
  void close() override { mpi_.close(); }
  [[noreturn]] void abort(int exit_code) override {
    mpi_.abort(exit_code);
    std::_Exit(exit_code);
  }

 private:
  // The version is the last text of the message.
  static void change(std::vector<std::byte>& bytes) {
    const char* const value = std::getenv("ETENDUE_TEST_FAULT");
    const std::string fault = value ? value : "";
    if (fault == "results" && bytes.size() >= kLargeMessage) bytes[bytes.size() / 2] ^= std::byte{1};
    if (fault == "version" && bytes.at(0) == kReady) bytes.back() = std::byte{'x'};
  }

  cluster::Communicator& mpi_;
};

cluster::Communicator* join() {
  void* const library = dlopen(ETENDUE_MPI_PLUGIN, RTLD_NOW | RTLD_GLOBAL);
  if (!library) return nullptr;
  using GetPlugin = const void* (*)(int);
  const auto get_plugin = reinterpret_cast<GetPlugin>(dlsym(library, cluster::kGetMpiPlugin));
  const void* const plugin = get_plugin ? get_plugin(cluster::kMpiPluginVersion) : nullptr;
  cluster::Communicator* const mpi = plugin ? (*static_cast<const cluster::JoinJob*>(plugin))() : nullptr;
  if (!mpi) return nullptr;
  static DamagingRank rank(*mpi);
  return &rank;
}

}  // namespace
}  // namespace etendue::test

extern "C" [[gnu::visibility("default")]] const void* etendue_mpi_plugin(int version) {
  static const etendue::cluster::JoinJob join_job = etendue::test::join;
  return version == etendue::cluster::kMpiPluginVersion ? static_cast<const void*>(&join_job) : nullptr;
}
