// Renderings on several ranks, started by mpirun. Skipped where Open MPI is missing.
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "image/image.h"
#include "integration/cli/cli.h"

namespace etendue::test::mpi_test {
namespace {

const std::string kScene = "render cornell --size 40x24 --seed 5 --threads 1 ";

class Mpi : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (std::system("mpirun --version >/dev/null 2>&1") != 0 ||
        !fs::exists(fs::path(ETENDUE_BINARY).parent_path() / "libetendue_mpi.so"))
      GTEST_SKIP() << "needs the packages openmpi-bin and libopenmpi-dev";
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    // Workers of other tests may use all cores.
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 1);
    // Open MPI keeps memory until the end of the process.
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
  }

  // The messages of mpirun itself are not part of `err`. The time limit only ends a job that hangs.
  Outcome mpirun(const std::string& arguments) const {
    const fs::path out = folder_ / "out.txt", err = folder_ / "err.txt";
    const std::string command =
        "cd " + folder_.string() + " && timeout 300 mpirun " + arguments + " >" + out.string() + " 2>" + err.string();
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), own_lines(slurp(err))};
  }
  Outcome render(int ranks, const std::string& options) const {
    return mpirun("-n " + std::to_string(ranks) + " " + ETENDUE_BINARY + " " + kScene + options);
  }
  static std::string own_lines(const std::string& text) {
    std::istringstream stream(text);
    std::string own;
    for (std::string line; std::getline(stream, line);)
      if (line.starts_with("etendue: ")) own += line + "\n";
    return own;
  }

  std::vector<float> radiance(const std::string& file) const {
    const auto image = image::read_exr(folder_ / file);
    EXPECT_TRUE(image) << image.error().message;
    return image ? image->layers.at(0).pixels : std::vector<float>();
  }
  void expect_same_image(const std::string& a, const std::string& b) const {
    const auto image = image::read_exr(folder_ / a), other = image::read_exr(folder_ / b);
    ASSERT_TRUE(image && other);
    ASSERT_EQ(image->layers.size(), other->layers.size());
    for (const auto& layer : image->layers) {
      const image::Layer* same = other->find(layer.name);
      ASSERT_TRUE(same) << layer.name;
      EXPECT_TRUE(layer.pixels == same->pixels) << layer.name << " of " << b;
    }
    const auto claim = nlohmann::json::parse(image->attributes.at("etendue:certificate"));
    const auto other_claim = nlohmann::json::parse(other->attributes.at("etendue:certificate"));
    EXPECT_EQ(claim["rmse"], other_claim["rmse"]);
  }
  void expect_refused(const std::string& arguments, int code, const std::string& message) const {
    std::ofstream(folder_ / "out.exr") << "kept";
    const Outcome r = mpirun(arguments + " -o out.exr");
    EXPECT_EQ(r.code, code) << arguments << "\n" << r.err;
    EXPECT_NE(r.err.find(message), std::string::npos) << r.err;
    EXPECT_EQ(r.err.find('\n'), r.err.size() - 1) << r.err;
    EXPECT_EQ(slurp(folder_ / "out.exr"), "kept");
  }
};

TEST_F(Mpi, AnyNumberOfRanksGivesTheBitsOfOneProcess) {
  for (const std::string integrator : {"path", "bdpt", "light", "sppm"}) {
    const std::string options = "--spp 17 --integrator " + integrator + " -o ";
    ASSERT_EQ(run(kScene + options + "one.exr").code, 0);
    for (const int ranks : {1, 2, 3, 5}) {
      const std::string out = "ranks" + std::to_string(ranks) + ".exr";
      const Outcome r = render(ranks, options + out);
      ASSERT_EQ(r.code, 0) << r.err;
      expect_same_image("one.exr", out);
    }
  }
}

TEST_F(Mpi, CollectorsKeepTheBits) {
  for (const std::string integrator : {"path", "light"}) {
    const std::string options = "--spp 200 --integrator " + integrator + " -o ";
    ASSERT_EQ(run(kScene + options + "one.exr").code, 0);
    for (const int collectors : {1, 2, 9}) {
      const Outcome r = render(5, options + "ranks.exr --collectors " + std::to_string(collectors));
      ASSERT_EQ(r.code, 0) << r.err;
      EXPECT_NE(r.err.find("ranks that added results: " + std::to_string(std::min(collectors, 4))), std::string::npos)
          << r.err;
      expect_same_image("one.exr", "ranks.exr");
    }
  }
}

TEST_F(Mpi, LimitsHoldForAllRanksTogether) {
  for (const std::string limit : {"--time 0.5", "--error 0.05", "--time 0.5 --collectors 1"}) {
    const Outcome r = render(3, limit + " -o limited.exr --json limited.json");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto statistics = nlohmann::json::parse(slurp(folder_ / "limited.json"));
    const uint32_t samples = statistics.at("spp");
    ASSERT_GT(samples, 0U);
    ASSERT_EQ(run(kScene + "--spp " + std::to_string(samples) + " -o one.exr").code, 0);
    expect_same_image("one.exr", "limited.exr");
  }
}

TEST_F(Mpi, BadInputIsReportedInOneLine) {
  const std::string program = std::string(" ") + ETENDUE_BINARY + " ";
  expect_refused("-n 3" + program + kScene + "--spp 8 --integrator mlt", 2, "mlt does not divide into samples");
  expect_refused("-n 3" + program + kScene + "--spp 8 --set render.adaptive=rmse", 2,
                 "adaptive sampling does not divide");
  expect_refused("-n 3" + program + kScene + "--samples 0:8", 2, "mpirun divides the rendering itself");
  expect_refused("-n 3" + program + kScene + "--no-such-option", 2, "--no-such-option");
  expect_refused("-n 3" + program + "render missing.glb --spp 8", 3, "missing.glb");
  expect_refused("-n 2 " + program + kScene + "--resume missing.checkpoint", 3, "missing.checkpoint");
}

TEST_F(Mpi, CommandsThatDoNotDivideAreRefused) {
  const std::string program = std::string("-n 3 ") + ETENDUE_BINARY + " ";
  for (const std::string command : {"save cornell", "merge a.exr b.exr"})
    expect_refused(program + command, 2, command.substr(0, command.find(' ')) + ": does not divide among the 3 ranks");
  // One process is the same as without mpirun.
  EXPECT_EQ(mpirun(std::string("-n 1 ") + ETENDUE_BINARY + " save cornell -o one.glb").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "one.glb"));
}

// One rank renders as without mpirun, also what does not divide.
TEST_F(Mpi, OneRankRendersAsOneProcess) {
  for (const std::string integrator : {"mlt", "path"}) {
    const std::string options = "--spp 4 --integrator " + integrator + " -o ";
    ASSERT_EQ(run(kScene + options + "one.exr").code, 0);
    const Outcome alone = render(1, options + "rank.exr");
    ASSERT_EQ(alone.code, 0) << alone.err;
    EXPECT_EQ(alone.err.find("rank rendered"), std::string::npos) << alone.err;
    expect_same_image("one.exr", "rank.exr");
  }
}

// mpirun takes 0 for the number of processors of this machine, or refuses it.
TEST_F(Mpi, ZeroRanks) {
  const Outcome r = render(0, "--spp 4 -o zero.exr");
  if (r.code != 0) {
    EXPECT_FALSE(fs::exists(folder_ / "zero.exr"));
    return;
  }
  ASSERT_EQ(run(kScene + "--spp 4 -o one.exr").code, 0);
  expect_same_image("one.exr", "zero.exr");
}

#ifdef ETENDUE_DAMAGING_MPI_FOLDER
// Arguments of mpirun for three ranks, the last of which has a fault (damaging_mpi/plugin.cpp).
std::string faulty(const std::string& fault) {
  return std::string("-n 3 -x ETENDUE_PLUGIN_PATH=") + ETENDUE_DAMAGING_MPI_FOLDER + " -x ETENDUE_TEST_FAULT=" + fault +
         " " + ETENDUE_BINARY + " ";
}

TEST_F(Mpi, DamagedResultsAreRenderedAgain) {
  const Outcome r = mpirun(faulty("results") + kScene + "--spp 200 -o damaged.exr");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("damaged results: "), std::string::npos) << r.err;
  ASSERT_EQ(run(kScene + "--spp 200 -o one.exr").code, 0);
  expect_same_image("one.exr", "damaged.exr");
}

TEST_F(Mpi, RanksOfAnotherVersionAreRefused) {
  expect_refused(faulty("version") + kScene + "--spp 8", 3, "rank 2: runs etendue ");
}
#endif

TEST_F(Mpi, ARankWithoutTheSceneFileEndsTheJob) {
  ASSERT_EQ(run("save cornell -o scene.glb").code, 0);
  fs::create_directories(folder_ / "empty");
  const std::string command = std::string(ETENDUE_BINARY) + " render scene.glb --size 40x24 --spp 8";
  expect_refused("-n 2 " + command + " -o out.exr : -n 1 --wdir " + (folder_ / "empty").string() + " " + command, 3,
                 "rank 2: ");
  fs::copy_file(folder_ / "scene.glb", folder_ / "empty" / "scene.glb");
  ASSERT_EQ(run("save cornell-spheres -o empty/scene.glb").code, 0);
  expect_refused("-n 2 " + command + " -o out.exr : -n 1 --wdir " + (folder_ / "empty").string() + " " + command, 3,
                 "has another content there than on rank 0");
}

// Ranks in a folder without the files: rank 0 sends the scene, its buffer, its textures and its environment map.
TEST_F(Mpi, RankZeroSendsTheFilesOfTheScene) {
  ASSERT_EQ(run("save cornell-spheres -o scene.gltf").code, 0);
  ASSERT_TRUE(fs::exists(folder_ / "scene.bin"));
  ASSERT_EQ(run("render cornell --size 8x8 --spp 1 -o environment.hdr").code, 0);
  fs::create_directories(folder_ / "empty");
  const std::string arguments = "render scene.gltf --size 40x24 --spp 17 --threads 1 --env environment.hdr";
  const std::string command = std::string(ETENDUE_BINARY) + " " + arguments;
  const std::string other = " : -n 3 --wdir " + (folder_ / "empty").string() + " ";
  const std::string sent = command + " --scene-from rank0 -o sent.exr";
  const Outcome r = mpirun("-n 1 " + sent + other + sent);
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("4 ranks rendered"), std::string::npos) << r.err;
  ASSERT_EQ(run(arguments + " -o one.exr").code, 0);
  expect_same_image("one.exr", "sent.exr");
  expect_refused("-n 1 " + command + " -o out.exr" + other + command, 3, "there is no such file");
  // Arguments that only another rank cannot read end the job too.
  expect_refused("-n 1 " + command + " -o out.exr : -n 1 " + command + " --no-such-option", 2, "rank 1: ");
}

TEST_F(Mpi, WithoutThePluginTheReasonIsReported) {
  expect_refused(
      std::string("-n 2 -x ETENDUE_PLUGIN_PATH=") + folder_.string() + " " + ETENDUE_BINARY + " " + kScene + "--spp 8",
      3, "libetendue_mpi.so");
}

// A job in the background, one of whose ranks is ended.
class FailingJob {
 public:
  FailingJob(const fs::path& folder, const std::string& arguments) : pid_(fork()) {
    if (pid_ != 0) return;
    const std::string command = "cd " + folder.string() + " && exec timeout 300 mpirun " + arguments + " >job.txt 2>&1";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    std::_Exit(127);
  }

  // Sends a signal to a rank.
  bool signal_rank(int rank, int signal) const {
    const std::string mark = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
    for (const int mpirun : children_of(pid_))
      for (const int process : children_of(mpirun)) {
        const std::string environment = slurp("/proc/" + std::to_string(process) + "/environ");
        if (environment.find(mark + '\0') != std::string::npos) return kill(process, signal) == 0;
      }
    return false;
  }
  // Sends a signal to mpirun.
  bool signal_mpirun(int signal) const {
    const auto mpirun = children_of(pid_);
    return mpirun.size() == 1 && kill(mpirun[0], signal) == 0;
  }
  int exit_code() const {
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  static std::vector<int> children_of(int process) {
    const std::string id = std::to_string(process);
    std::istringstream list(slurp("/proc/" + id + "/task/" + id + "/children"));
    std::vector<int> children;
    for (int child = 0; list >> child;) children.push_back(child);
    return children;
  }

  pid_t pid_;
};

// Jobs that do not end by themselves, so that the tests do not depend on the speed of the machine.
class FailingRank : public Mpi {
 protected:
  const std::string program_ = std::string(ETENDUE_BINARY) + " ";
  const std::string scene_ = "render cornell --size 128x128 --seed 5 --threads 1 ";
  void wait_for_checkpoint() const {
    const fs::path checkpoint = folder_ / "out.exr.checkpoint";
    std::error_code code;
    const auto before = fs::last_write_time(checkpoint, code);
    const auto is_new = [&] { return fs::exists(checkpoint) && fs::last_write_time(checkpoint, code) != before; };
    for (int i = 0; i < 6000 && !is_new(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ASSERT_TRUE(is_new()) << slurp(folder_ / "job.txt");
  }
  std::string endless(const std::string& integrator) const {
    return scene_ + "--integrator " + integrator + " --spp 1000000 --checkpoint 0.2 -o out.exr";
  }
  // One more than the last sample of a checkpoint.
  uint32_t end_of(const std::string& checkpoint) const {
    const std::string state = slurp(folder_ / checkpoint), member = "\"sample_ranges\":";
    const size_t begin = state.find(member);
    if (begin == std::string::npos) return 0;
    const size_t list = begin + member.size();
    return nlohmann::json::parse(state.substr(list, state.find("]]", list) + 2 - list)).back()[1];
  }
  // Continues a checkpoint by a few samples. The result has the bits of one process. A time limit would not do: a single
  // process stops within a sample.
  void expect_resumed(int ranks, const std::string& checkpoint, const std::string& integrator = "path") const {
    const uint32_t end = end_of(checkpoint);
    ASSERT_GT(end, 0U);
    const std::string samples = " --spp " + std::to_string(end + 3) + " ";
    const std::string arguments = "render --resume " + checkpoint + samples + "--threads 1 -o resumed.exr";
    const Outcome r = ranks > 1 ? mpirun("-n " + std::to_string(ranks) + " " + program_ + arguments) : run(arguments);
    ASSERT_EQ(r.code, 0) << r.err;
    ASSERT_EQ(run(scene_ + "--integrator " + integrator + samples + "-o one.exr").code, 0);
    expect_same_image("one.exr", "resumed.exr");
  }
};

TEST_F(FailingRank, AnotherNumberOfRanksContinuesFromTheCheckpoint) {
  for (const std::string integrator : {"path", "bdpt", "sppm", "light"}) {
    SCOPED_TRACE(integrator);
    FailingJob job(folder_, "-n 3 " + program_ + endless(integrator));
    wait_for_checkpoint();
    ASSERT_TRUE(job.signal_rank(2, SIGKILL));
    EXPECT_NE(job.exit_code(), 0);
    fs::copy_file(folder_ / "out.exr.checkpoint", folder_ / "copy.checkpoint", fs::copy_options::overwrite_existing);
    expect_resumed(2, "out.exr.checkpoint", integrator);
    EXPECT_FALSE(fs::exists(folder_ / "out.exr.checkpoint"));
    expect_resumed(1, "copy.checkpoint", integrator);
  }
}

// As the user does it by Ctrl-C. mpirun ends all ranks; rank 0 writes a checkpoint first.
TEST_F(FailingRank, InterruptingMpirunLeavesACheckpoint) {
  FailingJob job(folder_, "-n 3 " + program_ + scene_ + "--spp 1000000 -o out.exr");
  // Rank 0 reports the progress, every ten seconds if the output is not a terminal.
  const auto progress_lines = [&] {
    std::istringstream stream(slurp(folder_ / "job.txt"));
    int lines = 0;
    for (std::string line; std::getline(stream, line);) lines += line.find(" %  ") != std::string::npos ? 1 : 0;
    return lines;
  };
  for (int i = 0; i < 1200 && progress_lines() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(progress_lines(), 1) << slurp(folder_ / "job.txt");
  ASSERT_TRUE(job.signal_mpirun(SIGINT));
  EXPECT_NE(job.exit_code(), 0);
  ASSERT_TRUE(fs::exists(folder_ / "out.exr.checkpoint")) << slurp(folder_ / "job.txt");
  expect_resumed(2, "out.exr.checkpoint");
}

TEST_F(FailingRank, DoesNotEndTheJobWithRecovery) {
  FailingJob job(folder_, "--enable-recovery -n 3 " + program_ + endless("path"));
  wait_for_checkpoint();
  ASSERT_TRUE(job.signal_rank(1, SIGKILL));
  wait_for_checkpoint();
  ASSERT_TRUE(job.signal_rank(0, SIGINT));
  job.exit_code();  // that of mpirun, which ignores those of the ranks
  EXPECT_TRUE(fs::exists(folder_ / "out.exr"));
  expect_resumed(2, "out.exr.checkpoint");
}

// Rank 1 adds the results of the ranks 1 to 3. Its samples are rendered again.
TEST_F(FailingRank, ThatAddsResultsCostsOnlyItsSamples) {
  const std::string scene = "render cornell --size 64x64 --seed 5 --threads 1 --spp 3000 ";
  FailingJob job(folder_, "--enable-recovery -n 4 " + program_ + scene + "--collectors 1 --checkpoint 0.2 -o out.exr");
  for (int i = 0; i < 5; ++i) wait_for_checkpoint();
  ASSERT_TRUE(job.signal_rank(1, SIGKILL));
  job.exit_code();  // the job is aborted at the end, because a rank does not answer
  ASSERT_TRUE(fs::exists(folder_ / "out.exr")) << slurp(folder_ / "job.txt");
  EXPECT_NE(slurp(folder_ / "job.txt").find("of which failed: 1"), std::string::npos) << slurp(folder_ / "job.txt");
  ASSERT_EQ(run(scene + "-o one.exr").code, 0);
  expect_same_image("one.exr", "out.exr");
}

TEST_F(FailingRank, ThatHangsDoesNotStopTheOthers) {
  FailingJob job(folder_, "-n 3 " + program_ + endless("path"));
  wait_for_checkpoint();
  ASSERT_TRUE(job.signal_rank(1, SIGSTOP));
  wait_for_checkpoint();
  ASSERT_TRUE(job.signal_rank(0, SIGINT));
  EXPECT_NE(job.exit_code(), 0) << slurp(folder_ / "job.txt");
  EXPECT_TRUE(fs::exists(folder_ / "out.exr"));
  expect_resumed(1, "out.exr.checkpoint");
}

}  // namespace
}  // namespace etendue::test::mpi_test
