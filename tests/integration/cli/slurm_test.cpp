// The scripts of tools/cluster with a real scheduler on this machine, and with GNU parallel.
//
// The scheduler consists of slurmctld, slurmd and munged with folders, keys and ports of the test. Skipped where the
// packages slurm-wlm and munge are missing, or where the daemons do not run.
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "image/image.h"
#include "integration/cli/cli.h"

namespace etendue::test::slurm_test {
namespace {

// Programs of the system administrator may not be in the search path of a user.
const std::string kPath = "PATH=$PATH:/usr/sbin:/sbin ";

bool is_installed(const std::string& program) {
  return std::system((kPath + "command -v " + program + " >/dev/null").c_str()) == 0;
}

std::string output_of(const std::string& command) {
  std::string text;
  if (std::FILE* pipe = popen(command.c_str(), "r")) {
    std::array<char, 256> buffer;
    while (const size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
    pclose(pipe);
  }
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

class ClusterScripts : public Cli {
 protected:
  int script(const std::string& environment, const std::string& command) const {
    const std::string line = "cd " + folder_.string() + " && export ETENDUE=" + ETENDUE_BINARY + " " + environment +
                             " && " + ETENDUE_SOURCE_DIR + "/tools/cluster/" + command + " >log.txt 2>&1";
    return std::system(line.c_str());
  }
  std::string log() const { return slurp(folder_ / "log.txt"); }

  void expect_image_of_one_run(const std::string& file) const {
    ASSERT_EQ(run("render cornell --size 40x24 --seed 5 --spp 10 -o one.exr").code, 0);
    const auto one = image::read_exr(folder_ / "one.exr"), other = image::read_exr(folder_ / file);
    ASSERT_TRUE(one && other) << log();
    ASSERT_EQ(one->layers.size(), other->layers.size());
    for (const auto& layer : one->layers) {
      const image::Layer* same = other->find(layer.name);
      ASSERT_TRUE(same) << layer.name;
      EXPECT_TRUE(layer.pixels == same->pixels) << layer.name;
    }
  }
};

// A cluster of one machine with two processors.
class Slurm : public ClusterScripts {
 protected:
  void SetUp() override {
    ClusterScripts::SetUp();
    for (const char* program : {"slurmctld", "slurmd", "munged", "sbatch"})
      if (!is_installed(program)) GTEST_SKIP() << "needs the packages slurm-wlm and munge";
    write_configuration();
    start("munged --foreground --force --key-file=munge.key --socket=" + file("munge.socket") +
          " --pid-file=" + file("munged.pid") + " --log-file=" + file("munged.log") + " --seed-file=" + file("seed"));
    start("slurmctld -D -c -f " + file("slurm.conf"));
    start("slurmd -D -f " + file("slurm.conf"));
    for (int i = 0; i < 300; ++i) {
      if (slurm("sinfo --noheader --format=%t") == "idle") return;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    GTEST_SKIP() << "slurmctld and slurmd do not run here: " << slurp(folder_ / "daemons.txt");
  }
  void TearDown() override {
    for (const pid_t daemon : daemons_) kill(daemon, SIGTERM);
    for (const pid_t daemon : daemons_) waitpid(daemon, nullptr, 0);
    Cli::TearDown();
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string slurm(const std::string& command) const {
    return output_of("SLURM_CONF=" + file("slurm.conf") + " timeout 30 " + command + " 2>>" + file("daemons.txt"));
  }
  // The queue is empty.
  void wait_for_jobs() const {
    for (int i = 0; i < 1200 && !slurm("squeue --noheader").empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(slurm("squeue --noheader"), "");
  }

 private:
  void write_configuration() const {
    std::string key;
    for (int i = 0; i < 64; ++i) key += "etendue test key";
    std::ofstream(folder_ / "munge.key") << key;
    fs::permissions(folder_ / "munge.key", fs::perms::owner_read);
    for (const char* folder : {"state", "spool"}) fs::create_directories(folder_ / folder);
    const std::string host = output_of("hostname"), user = output_of("id -un");
    const int port = 20000 + 2 * (::getpid() % 10000);
    std::ofstream(folder_ / "slurm.conf")
        << "ClusterName=test\nSlurmctldHost=" << host << "(127.0.0.1)\nSlurmUser=" << user << "\nSlurmdUser=" << user
        << "\nSlurmctldPort=" << port << "\nSlurmdPort=" << port + 1 << "\nAuthInfo=socket=" << file("munge.socket")
        << "\nStateSaveLocation=" << file("state") << "\nSlurmdSpoolDir=" << file("spool")
        << "\nSlurmctldPidFile=" << file("ctld.pid") << "\nSlurmdPidFile=" << file("slurmd.pid")
        << "\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nSwitchType=switch/none\nMpiDefault=none\n"
           "SelectType=select/cons_tres\nSelectTypeParameters=CR_CPU\nSchedulerType=sched/builtin\nReturnToService=2\n"
        << "NodeName=" << host << " NodeAddr=127.0.0.1 CPUs=" << output_of("nproc --all")
        << "\nPartitionName=all Nodes=ALL Default=YES State=UP\n";
  }
  void start(const std::string& command) {
    const pid_t pid = fork();
    if (pid == 0) {
      const std::string line = "cd " + folder_.string() + " && " + kPath + "exec " + command + " >>daemons.txt 2>&1";
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      std::_Exit(127);
    }
    daemons_.push_back(pid);
  }

  std::vector<pid_t> daemons_;
};

TEST_F(Slurm, ArrayAndMergeGiveTheImageOfOneRun) {
  const std::string environment = "SLURM_CONF=" + file("slurm.conf") + " SBATCH_OPTIONS=--cpus-per-task=1";
  const std::string submit = "submit.sh 3 10 array.exr cornell --size 40x24 --seed 5";
  ASSERT_EQ(script(environment, submit), 0) << log();
  wait_for_jobs();
  ASSERT_TRUE(fs::exists(folder_ / "array.exr")) << log() << output_of("cat " + folder_.string() + "/etendue*.log");
  expect_image_of_one_run("array.exr");
}

// The merge does not run after a task that failed; nothing is written.
TEST_F(Slurm, AFailedTaskPreventsTheMerge) {
  const std::string environment = "SLURM_CONF=" + file("slurm.conf") + " SBATCH_OPTIONS=--cpus-per-task=1";
  ASSERT_EQ(script(environment, "submit.sh 2 10 array.exr cornell --size 40x24 --integrator mlt"), 0) << log();
  wait_for_jobs();
  EXPECT_FALSE(fs::exists(folder_ / "array.exr"));
  const std::string logs = output_of("cat " + folder_.string() + "/etendue-*.log");
  EXPECT_NE(logs.find("mlt does not divide into samples"), std::string::npos) << logs;
  EXPECT_EQ(logs.find("merge"), std::string::npos) << logs;
}

TEST_F(ClusterScripts, GnuParallelRendersAndMerges) {
  if (!is_installed("parallel") || output_of("parallel --version").find("GNU parallel") == std::string::npos)
    GTEST_SKIP() << "needs the package parallel";
  const std::string command = "render_with_parallel.sh : 3 10 parallel.exr cornell --size 40x24 --seed 5";
  ASSERT_EQ(script("LC_ALL=C", command), 0) << log();
  expect_image_of_one_run("parallel.exr");
  // Only the missing part is rendered again.
  const auto kept = fs::last_write_time(folder_ / "parallel.parts" / "part-0.exr");
  fs::remove(folder_ / "parallel.parts" / "part-1.exr");
  fs::remove(folder_ / "parallel.exr");
  ASSERT_EQ(script("LC_ALL=C", command), 0) << log();
  EXPECT_EQ(fs::last_write_time(folder_ / "parallel.parts" / "part-0.exr"), kept);
  expect_image_of_one_run("parallel.exr");
  EXPECT_NE(script("LC_ALL=C", "render_with_parallel.sh : 3 10 out.exr cornell --integrator mlt"), 0);
  EXPECT_FALSE(fs::exists(folder_ / "out.exr"));
  EXPECT_NE(script("LC_ALL=C", "render_with_parallel.sh : 11 10 out.exr cornell"), 0);
}

}  // namespace
}  // namespace etendue::test::slurm_test
