// Output that cannot be written: full disks, read-only folders, devices, and environments without a home or cache
// folder. The tests also hold for the superuser, who may write everywhere except to /proc.
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>

#include "integration/cli/cli.h"

namespace etendue::test::unwritable_test {
namespace {

constexpr const char* kSmall = "render cornell --size 8x8 --spp 1 ";
constexpr const char* kLarge = "render cornell --size 192x192 --spp 2 ";

// A disk of 64 KiB. Mounting needs the rights of the superuser; without them the tests are skipped.
class SmallDisk : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    disk_ = folder_ / "disk";
    fs::create_directory(disk_);
    mounted_ = ::mount("tmpfs", disk_.c_str(), "tmpfs", 0, "size=64k") == 0;
    if (!mounted_) GTEST_SKIP() << "a small disk cannot be mounted";
  }
  void TearDown() override {
    if (mounted_) ::umount2(disk_.c_str(), MNT_DETACH);
    Cli::TearDown();
  }

  // Leaves no free block.
  void fill() const {
    std::FILE* file = std::fopen((disk_ / "filler").c_str(), "wb");
    ASSERT_NE(file, nullptr);
    const std::string block(4096, 'x');
    while (std::fwrite(block.data(), 1, block.size(), file) == block.size() && std::fflush(file) == 0) continue;
    std::fclose(file);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(disk_)) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  fs::path disk_;
  bool mounted_ = false;
};

TEST_F(SmallDisk, KeepsTheEarlierImageWhenItIsFull) {
  for (const std::string extension : {"exr", "png", "hdr"}) {
    const std::string name = "a." + extension, file = "disk/" + name;
    ASSERT_EQ(run(kSmall + ("-o " + file)).code, 0);
    const std::string earlier = slurp(disk_ / name);
    ASSERT_FALSE(earlier.empty());
    expect_error(kLarge + ("-o " + file), 4, file + ": could not be written completely; is the disk full?");
    EXPECT_EQ(slurp(disk_ / name), earlier) << extension;
    EXPECT_EQ(names(), std::vector<std::string>{name});
    fs::remove(disk_ / name);
  }
}

// The last bytes of a small file are written when it is closed.
TEST_F(SmallDisk, AFileOfAFewBytesIsComplete) {
  fill();
  for (const char* name : {"a.exr", "a.png", "a.hdr"}) {
    expect_error(kSmall + ("-o disk/" + std::string(name)), 4, "could not be written completely");
    EXPECT_EQ(names(), std::vector<std::string>{"filler"}) << name;
  }
  expect_error("save cornell -o disk/a.glb", 4, "could not be written completely");
  EXPECT_EQ(names(), std::vector<std::string>{"filler"});
}

TEST_F(SmallDisk, KeepsTheEarlierCheckpointWhenItIsFull) {
  run("render cornell --size 8x8 --spp 1000000 --checkpoint 0.1 -o disk/a.png & sleep 1; kill -9 $!; wait $!");
  const fs::path checkpoint = disk_ / "a.png.checkpoint";
  const std::string earlier = slurp(checkpoint);
  ASSERT_FALSE(earlier.empty());
  for (const auto& name : names())
    if (name.starts_with(".")) fs::remove(disk_ / name);
  fill();
  expect_error("render cornell --resume disk/a.png.checkpoint --time 1000 --checkpoint 0.1 -o disk/a.png", 4,
               "a.png.checkpoint: could not be written completely");
  EXPECT_EQ(slurp(checkpoint), earlier);
  fs::remove(disk_ / "filler");
  EXPECT_EQ(run("render cornell --resume disk/a.png.checkpoint --spp 1 -o disk/a.png").code, 0);
}

TEST_F(Cli, IncompleteStandardOutputIsAnError) {
  ASSERT_EQ(run(kSmall + std::string("-o a.exr")).code, 0);
  for (const char* command : {"list integrators", "list integrators --json", "inspect cornell", "compare a.exr a.exr",
                              "render cornell --size 8x8 --spp 1 -o b.exr --json -", "--help", "--version"}) {
    // The redirection of the fixture follows; the first one holds inside the group.
    const std::string binary = ETENDUE_BINARY;
    const Outcome r = run("--version >/dev/null; { " + binary + " " + command + " >/dev/full; }");
    EXPECT_EQ(r.code, 4) << command;
    EXPECT_EQ(r.err, "etendue: standard output could not be written completely; is the disk full?\n") << command;
  }
}

// A device is written to, not replaced by a file.
TEST_F(Cli, DevicesAreNotReplaced) {
  if (::mknod((folder_ / "full").c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0) GTEST_SKIP() << "no rights for mknod";
  expect_error(kSmall + std::string("-o a.exr --json full"), 4, "full: could not be written completely");
  EXPECT_TRUE(fs::is_character_file(folder_ / "full"));
}

TEST_F(Cli, SymbolicLinksAreFollowed) {
  fs::create_directory(folder_ / "images");
  fs::create_symlink("images/a.exr", folder_ / "link.exr");
  ASSERT_EQ(run(kSmall + std::string("-o images/a.exr")).code, 0);
  const std::string earlier = slurp(folder_ / "images/a.exr");
  ASSERT_EQ(run(kSmall + std::string("--seed 2 -o link.exr")).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.exr"));
  EXPECT_NE(slurp(folder_ / "images/a.exr"), earlier);
}

TEST_F(Cli, APipeIsNoInput) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.glb").c_str(), 0600), 0);
  expect_error("inspect pipe.glb", 3, "pipe.glb: this is a device or a pipe; give a file");
}

// Nothing is rendered first: the limits would take hours.
// File names on Linux are bytes, which need not be UTF-8.
TEST_F(Cli, NamesThatAreNotUtf8) {
  ASSERT_EQ(run("save cornell -o $(printf 'caf\\351.glb')").code, 0);
  for (const char* job :
       {"render $(printf 'caf\\351.glb') --size 16x16 --spp 1 -o out.exr --json s.json",
        "inspect $(printf 'caf\\351.glb') --json", "probe $(printf 'caf\\351.glb') --at 300 300 --json"}) {
    const Outcome r = run(job);
    EXPECT_EQ(r.code, 0) << job << r.err;
  }
  EXPECT_TRUE(fs::exists(folder_ / "out.exr"));
  EXPECT_EQ(run("compare out.exr out.exr").code, 0);
}

TEST_F(Cli, ReadOnlyFoldersFailBeforeRendering) {
  const std::string hours = "render cornell --size 512x512 --spp 1000000 ";
  for (const char* extension : {"exr", "png", "hdr"})
    expect_error(hours + "-o /proc/a." + extension, 4, std::string("/proc/a.") + extension + ": cannot be written: ");
  expect_error(hours + "-o a.exr --png /proc/a.png", 4, "/proc/a.png: cannot be written: ");
  EXPECT_FALSE(fs::exists(folder_ / "a.exr"));
  expect_error("save cornell -o /proc/a.glb", 4, "/proc/a.glb: cannot be written: ");
  expect_error("save cornell -o /proc/a.gltf", 4, "/proc/a.");
  expect_error("bench cornell --methods path --samples 2 --size 16x16 --out /proc/d", 4, "/proc/d");
  expect_error("stress point-light-unseen --out /proc/d", 4, "/proc/d: the folder cannot be created: ");
}

TEST_F(Cli, AFileIsNoFolder) {
  ASSERT_EQ(run(kSmall + std::string("-o a.exr")).code, 0);
  const std::string earlier = slurp(folder_ / "a.exr");
  expect_error(kSmall + std::string("-o a.exr/b.exr"), 4, "the folder a.exr does not exist");
  expect_error("bench cornell --methods path --samples 2 --size 16x16 --out a.exr/d", 4, "a.exr/d");
  expect_error("stress point-light-unseen --out a.exr/d", 4, "a.exr/d: the folder cannot be created: ");
  EXPECT_EQ(slurp(folder_ / "a.exr"), earlier);
}

// Results do not depend on the home folder. An unusable cache is reported on standard error.
TEST_F(Cli, WorksWithoutHomeOrCacheFolder) {
  std::fclose(std::fopen((folder_ / "file").c_str(), "wb"));
  const std::string file = (folder_ / "file").string();
  const struct {
    std::string environment, note;
  } kCases[] = {{"-u HOME -u XDG_CACHE_HOME -u XDG_CONFIG_HOME", ""},
                {"-u XDG_CACHE_HOME -u XDG_CONFIG_HOME HOME=", ""},
                {"-u XDG_CACHE_HOME -u XDG_CONFIG_HOME HOME=" + file, "the reference is not cached"},
                {"XDG_CACHE_HOME=/proc/none XDG_CONFIG_HOME=/proc/none", "the reference is not cached"},
                {"XDG_CACHE_HOME=" + file + " XDG_CONFIG_HOME=" + file, "the reference is not cached"}};
  int number = 0;
  for (const auto& c : kCases) {
    const std::string program = "--version >/dev/null; env " + c.environment + " " + ETENDUE_BINARY + " ";
    const std::string out = "d" + std::to_string(number++);
    const Outcome bench = run(program + "bench cornell --methods path --samples 2 --size 16x16 --out " + out);
    EXPECT_EQ(bench.code, 0) << c.environment << "\n" << bench.err;
    EXPECT_TRUE(fs::exists(folder_ / out / "summary.json")) << c.environment;
    EXPECT_EQ(bench.err.find("is not cached") != std::string::npos, !c.note.empty()) << bench.err;
    EXPECT_EQ(run(program + kSmall + "-o a.exr").code, 0) << c.environment;
    EXPECT_FALSE(fs::exists(folder_ / ".config")) << c.environment;
    EXPECT_FALSE(fs::exists(folder_ / ".cache")) << c.environment;
  }
}

TEST_F(Cli, TheViewerWorksWithoutHomeOrCacheFolder) {
  std::FILE* script = std::fopen((folder_ / "s.json").c_str(), "wb");
  ASSERT_NE(script, nullptr);
  std::fputs(R"([{"do": "wait", "spp": 1}, {"do": "state", "file": "state.json"}])", script);
  std::fclose(script);
  for (const char* environment : {"-u HOME -u XDG_CACHE_HOME -u XDG_CONFIG_HOME", "HOME=/proc/none",
                                  "XDG_CACHE_HOME=/proc/none XDG_CONFIG_HOME=/proc/none"}) {
    const Outcome r = run(std::string("--version >/dev/null; env ") + environment + " " + ETENDUE_BINARY +
                          " view cornell --offscreen --script s.json");
    EXPECT_EQ(r.code, 0) << environment << "\n" << r.err;
    EXPECT_TRUE(fs::remove(folder_ / "state.json")) << environment;
  }
}

}  // namespace
}  // namespace etendue::test::unwritable_test
