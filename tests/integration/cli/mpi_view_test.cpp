// The viewer on several ranks, started by mpirun: equal images, faults and ends. Skipped where Open MPI is missing.
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "image/image.h"
#include "integration/cli/cli.h"

namespace etendue::test::mpi_view_test {
namespace {

using nlohmann::json;

std::vector<int> children_of(int process) {
  const std::string id = std::to_string(process);
  std::istringstream list(slurp("/proc/" + id + "/task/" + id + "/children"));
  std::vector<int> children;
  for (int child = 0; list >> child;) children.push_back(child);
  return children;
}

bool is_running(int process) {
  const std::string status = slurp("/proc/" + std::to_string(process) + "/stat");
  return !status.empty() && status.find(") Z ") == std::string::npos;
}

// A job in the background. It is ended with this object.
class ViewJob {
 public:
  ViewJob(const fs::path& folder, const std::string& arguments) : folder_(folder), pid_(fork()) {
    if (pid_ != 0) return;
    const std::string command = "cd " + folder.string() + " && exec timeout 300 mpirun " + arguments + " >job.txt 2>&1";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    std::_Exit(127);
  }
  ~ViewJob() {
    if (!has_ended_) kill(pid_, SIGTERM);
    if (!has_ended_) waitpid(pid_, nullptr, 0);
  }

  // The process of mpirun; 0 if there is none yet.
  int mpirun() const {
    const auto children = children_of(pid_);
    return children.empty() ? 0 : children[0];
  }
  int process_of(int rank) const {
    const std::string mark = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
    for (const int process : children_of(mpirun()))
      if (slurp("/proc/" + std::to_string(process) + "/environ").find(mark + '\0') != std::string::npos) return process;
    return 0;
  }
  std::vector<int> processes() const { return children_of(mpirun()); }
  // Waits until a file exists that the script writes.
  bool wait_for(const std::string& file) const {
    for (int i = 0; i < 2400 && !fs::exists(folder_ / file); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return fs::exists(folder_ / file);
  }
  int exit_code() {
    int status = 0;
    waitpid(pid_, &status, 0);
    has_ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string output() const { return slurp(folder_ / "job.txt"); }

 private:
  fs::path folder_;
  pid_t pid_;
  bool has_ended_ = false;
};

class MpiView : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (std::system("mpirun --version >/dev/null 2>&1") != 0 ||
        !fs::exists(fs::path(ETENDUE_BINARY).parent_path() / "libetendue_mpi.so"))
      GTEST_SKIP() << "needs the packages openmpi-bin and libopenmpi-dev";
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    // Open MPI keeps memory until the end of the process.
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
  }
  // Writes a script and returns the arguments of the program that runs it.
  std::string view(const json& steps, const std::string& name = "script.json") const {
    std::ofstream(folder_ / name) << steps.dump();
    return "view cornell --offscreen --size 480x320 --threads 1 --script " + name;
  }
  static std::string program() { return std::string(ETENDUE_BINARY) + " "; }
  static json set(const std::string& name, const json& value) {
    return {{"do", "set"}, {"name", name}, {"value", value}};
  }
  static json wait_spp(int samples) { return {{"do", "wait"}, {"spp", samples}}; }
  static json wait_seconds(double seconds) { return {{"do", "wait"}, {"seconds", seconds}}; }
  static json write_state(const std::string& file) { return {{"do", "state"}, {"file", file}}; }
  json state(const std::string& file) const { return json::parse(slurp(folder_ / file)); }
  std::vector<float> radiance(const std::string& file) const {
    const auto image = image::read_exr(folder_ / file);
    EXPECT_TRUE(image) << image.error().message;
    return image ? image->layers.at(0).pixels : std::vector<float>();
  }
  static bool all_end(const std::vector<int>& processes) {
    for (int i = 0; i < 600; ++i) {
      if (std::ranges::none_of(processes, is_running)) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  // Ends or stops a rank with a signal: the viewer goes on with the other, and all processes end with it.
  void expect_viewer_without_rank_1(int signal) const {
    const json steps = json::array({wait_spp(2), write_state("begun.json"), wait_seconds(12), wait_spp(4),
                                    set("material.0.roughness", 0.7), wait_spp(20), write_state("after.json")});
    ViewJob job(folder_, "--enable-recovery -n 3 " + program() + view(steps));
    ASSERT_TRUE(job.wait_for("begun.json")) << job.output();
    const auto processes = job.processes();
    ASSERT_EQ(processes.size(), 3U);
    ASSERT_EQ(kill(job.process_of(1), signal), 0);
    job.exit_code();  // that of mpirun, which ends ranks that do not answer
    ASSERT_TRUE(fs::exists(folder_ / "after.json")) << job.output();
    const json ranks = state("after.json").at("ranks");
    EXPECT_LE(ranks.at("active"), 2) << ranks;
    EXPECT_NE(ranks.at("note").get<std::string>().find("rank 1: does not answer"), std::string::npos) << ranks;
    EXPECT_GE(state("after.json").at("samples"), 20);
    EXPECT_TRUE(all_end(processes));
  }
  // Steps that never end by themselves.
  static json endless() { return json::array({wait_spp(2), write_state("begun.json"), wait_seconds(200)}); }
};

// An edit while samples of all ranks are on their way, and a limit.
TEST_F(MpiView, TheImageHasTheBitsOfOneProcess) {
  const auto steps = [&](const std::string& name) {
    return json::array({set("render.samples", 96),
                        set("material.0.roughness", 0.3),
                        wait_spp(6),
                        set("material.5.metallic", 1.0),
                        wait_spp(4),
                        set("material.5.roughness", 0.4),
                        wait_spp(96),
                        {{"do", "image"}, {"file", name + ".exr"}},
                        write_state(name + ".json")});
  };
  ASSERT_EQ(run(view(steps("one"))).code, 0);
  ViewJob job(folder_, "-n 3 " + program() + view(steps("ranks")));
  ASSERT_EQ(job.exit_code(), 0) << job.output();
  const json ranks = state("ranks.json").at("ranks");
  EXPECT_EQ(ranks.at("all"), 3);
  EXPECT_EQ(ranks.at("active"), 3) << ranks;
  EXPECT_GT(ranks.at("other_samples"), 0) << ranks;
  EXPECT_EQ(ranks.at("own_samples").get<int>() + ranks.at("other_samples").get<int>(), 96);
  EXPECT_TRUE(radiance("ranks.exr") == radiance("one.exr"));
  EXPECT_TRUE(state("one.json").at("ranks").is_null());
}

TEST_F(MpiView, IntegratorsThatDoNotDivideRunOnRank0) {
  const json steps = json::array({set("render.integrator", "mlt"), wait_spp(2), write_state("mlt.json"),
                                  set("render.integrator", "path"), wait_spp(60), write_state("path.json")});
  ViewJob job(folder_, "-n 2 " + program() + view(steps));
  ASSERT_EQ(job.exit_code(), 0) << job.output();
  EXPECT_EQ(state("mlt.json").at("ranks").at("active"), 1);
  EXPECT_NE(state("mlt.json").at("ranks").at("note").get<std::string>().find("mlt does not divide"), std::string::npos);
  EXPECT_EQ(state("path.json").at("ranks").at("active"), 2);
}

TEST_F(MpiView, ARankThatDiesDoesNotStopTheViewer) { expect_viewer_without_rank_1(SIGKILL); }
TEST_F(MpiView, ARankThatHangsDoesNotStopTheViewer) { expect_viewer_without_rank_1(SIGSTOP); }

TEST_F(MpiView, AllRanksEndWithRank0OrMpirun) {
  for (const bool interrupts_mpirun : {true, false}) {
    fs::remove(folder_ / "begun.json");
    ViewJob job(folder_, "-n 3 " + program() + view(endless()));
    ASSERT_TRUE(job.wait_for("begun.json")) << job.output();
    const auto processes = job.processes();
    ASSERT_EQ(processes.size(), 3U);
    ASSERT_EQ(interrupts_mpirun ? kill(job.mpirun(), SIGINT) : kill(job.process_of(0), SIGKILL), 0);
    EXPECT_NE(job.exit_code(), 0);
    EXPECT_TRUE(all_end(processes));
  }
}

// With --enable-recovery mpirun does not end the other ranks; they notice that rank 0 is silent.
TEST_F(MpiView, RanksEndWithoutRank0) {
  ViewJob job(folder_, "--enable-recovery -n 2 " + program() + view(endless()));
  ASSERT_TRUE(job.wait_for("begun.json")) << job.output();
  const auto processes = job.processes();
  ASSERT_EQ(kill(job.process_of(0), SIGKILL), 0);
  EXPECT_TRUE(all_end(processes));
}

}  // namespace
}  // namespace etendue::test::mpi_view_test
