// Renderings in parts: merged to the bits of one run, and refused where they do not belong together.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "image/image.h"
#include "integration/cli/cli.h"

namespace etendue::test::merge_test {
namespace {

const std::string kScene = "render cornell --size 40x24 --seed 5 ";

class Merge : public Cli {
 protected:
  void render(const std::string& options, const std::string& out) const {
    const Outcome r = run(kScene + options + " -o " + out);
    ASSERT_EQ(r.code, 0) << r.err;
  }
  void merge(const std::string& arguments) const {
    const Outcome r = run("merge " + arguments);
    ASSERT_EQ(r.code, 0) << r.err;
  }
  image::LayeredImage read(const std::string& file) const {
    auto image = image::read_exr(folder_ / file);
    EXPECT_TRUE(image) << image.error().message;
    return image ? *image : image::LayeredImage();
  }
  // All layers have the same bits, and the error that the certificate states is the same.
  void expect_same_image(const std::string& a, const std::string& b) const {
    const auto image = read(a), other = read(b);
    ASSERT_EQ(image.layers.size(), other.layers.size());
    for (const auto& layer : image.layers) {
      const image::Layer* same = other.find(layer.name);
      ASSERT_TRUE(same) << layer.name;
      ASSERT_EQ(layer.pixels.size(), same->pixels.size());
      EXPECT_EQ(std::memcmp(layer.pixels.data(), same->pixels.data(), layer.pixels.size() * sizeof(float)), 0) << b;
    }
    EXPECT_EQ(image.attributes.at("etendue:state"), other.attributes.at("etendue:state"));
    const auto claim = nlohmann::json::parse(image.attributes.at("etendue:certificate"));
    const auto other_claim = nlohmann::json::parse(other.attributes.at("etendue:certificate"));
    EXPECT_EQ(claim["rmse"], other_claim["rmse"]);
    EXPECT_EQ(claim["relmse"], other_claim["relmse"]);
  }
  // A merge that is refused leaves an existing output as it is.
  void expect_refused(const std::string& parts, int code, const std::string& message) const {
    std::ofstream(folder_ / "out.exr") << "kept";
    expect_error("merge " + parts + " -o out.exr", code, message);
    EXPECT_EQ(slurp(folder_ / "out.exr"), "kept") << parts;
  }
};

TEST_F(Merge, HalvesAndUnevenPartsHaveTheBitsOfOneRun) {
  for (const std::string integrator : {"path", "bdpt", "sppm", "light"}) {
    const std::string options = "--integrator " + integrator + " ";
    render(options + "--spp 24", "one.exr");
    render(options + "--samples 0:12", "a.exr");
    render(options + "--samples 12:24 --threads 1", "b.exr");
    merge("b.exr a.exr -o halves.exr");
    expect_same_image("one.exr", "halves.exr");

    const std::vector<int> bounds{0, 1, 4, 5, 11, 13, 20, 24};
    std::vector<std::string> parts;
    for (size_t i = 0; i + 1 < bounds.size(); ++i) {
      parts.push_back("p" + std::to_string(i) + ".exr");
      render(options + "--samples " + std::to_string(bounds[i]) + ":" + std::to_string(bounds[i + 1]), parts.back());
    }
    std::mt19937 engine(1);
    std::ranges::shuffle(parts, engine);
    std::string list, group, rest;
    for (size_t i = 0; i < parts.size(); ++i) {
      list += parts[i] + " ";
      (i < 3 ? group : rest) += parts[i] + " ";
    }
    merge(list + "-o seven.exr --spp 24");
    expect_same_image("one.exr", "seven.exr");
    merge(group + "--partial -o group.exr");
    merge(rest + "group.exr -o grouped.exr");
    expect_same_image("one.exr", "grouped.exr");
  }
}

TEST_F(Merge, RegionsAndStatistics) {
  const Outcome one = run(kScene + "--spp 16 -o one.exr --json -");
  ASSERT_EQ(one.code, 0) << one.err;
  render("--spp 16 --region 0,0,13,24", "left.exr");
  render("--samples 0:5 --region 13,0,27,24", "right1.exr");
  render("--samples 5:16 --region 13,0,27,24", "right2.exr");
  const Outcome merged = run("merge right2.exr left.exr right1.exr -o merged.exr --aov depth --png m.png --json -");
  ASSERT_EQ(merged.code, 0) << merged.err;
  EXPECT_TRUE(fs::exists(folder_ / "m.png"));
  EXPECT_TRUE(read("merged.exr").find("depth"));
  const auto j = nlohmann::json::parse(one.out), k = nlohmann::json::parse(merged.out);
  for (const char* key : {"integrator", "sampler", "spp", "width", "height", "seed", "rmse_estimate", "error",
                          "error_interval", "rejected", "model"})
    EXPECT_EQ(j[key], k[key]) << key;
  EXPECT_EQ(k["health"]["verdict"], "healthy");
  EXPECT_GT(k["seconds"], 0);
  // The tiles of both columns are traced for each region.
  EXPECT_GE(k["rays"], j["rays"]);
  EXPECT_EQ(run("merge right2.exr left.exr right1.exr -o again.exr").code, 0);
  render("--spp 16 --aov depth", "one-with-depth.exr");
  expect_same_image("one.exr", "again.exr");
  expect_same_image("one-with-depth.exr", "merged.exr");
}

// A part compares each sample with the earlier ones of its pixel in the part, so the statistics of tails differ from those
// of one run. Order and grouping do not matter.
TEST_F(Merge, TailStatisticsAreCloseToThoseOfOneRun) {
  const std::string scene = "render cornell-spheres --size 40x24 --seed 5 ";
  const auto health = [&](const std::string& command) {
    const Outcome r = run(command + " --json -");
    EXPECT_EQ(r.code, 0) << r.err;
    const auto statistics = nlohmann::json::parse(r.out);
    auto values = statistics.at("health");
    values["khat"] = statistics.at("khat");
    return values;
  };
  const auto one = health(scene + "--spp 256 -o one.exr");
  for (const auto& [samples, part] : {std::pair("0:100", "a"), std::pair("100:130", "b"), std::pair("130:256", "c")}) {
    const Outcome r = run(scene + "--samples " + samples + " -o " + part + ".exr");
    ASSERT_EQ(r.code, 0) << r.err;
  }
  const auto merged = health("merge a.exr b.exr c.exr -o merged.exr");
  EXPECT_EQ(merged, health("merge c.exr a.exr b.exr -o again.exr"));
  merge("c.exr b.exr --partial -o group.exr");
  EXPECT_EQ(merged, health("merge group.exr a.exr -o grouped.exr"));
  EXPECT_EQ(merged["verdict"], one["verdict"]);
  EXPECT_NEAR(merged["khat"].get<double>(), one["khat"].get<double>(), 2 * one["khat_error"].get<double>());
  const double vov = one["vov"];
  EXPECT_NEAR(merged["vov"].get<double>(), vov, 0.2 * vov);
}

// The program is interrupted after its first checkpoint, or ends before if it is fast.
TEST_F(Merge, InterruptedPartsAreResumed) {
  const std::string samples = "--samples 0:600 ";
  render(samples, "part.exr");
  const std::string script = "cd " + folder_.string() + "\n" + ETENDUE_BINARY + " " + kScene + samples +
                             "--checkpoint 0.01 -o cut.exr 2>err.txt &\n"
                             "job=$!\n"
                             "until [ -e cut.exr.checkpoint ] || ! kill -0 $job; do sleep 0.01; done\n"
                             "kill -TERM $job\nwait $job\n";
  std::ofstream(folder_ / "interrupt.sh") << script;
  std::system(("bash " + (folder_ / "interrupt.sh").string() + " 2>/dev/null").c_str());
  if (fs::exists(folder_ / "cut.exr.checkpoint")) {
    EXPECT_FALSE(fs::exists(folder_ / "cut.exr"));
    expect_error("render --resume cut.exr.checkpoint --samples 0:9 -o cut.exr", 2, "samples 0:600");
    const Outcome resumed = run("render --resume cut.exr.checkpoint -o cut.exr");
    EXPECT_EQ(resumed.code, 0) << resumed.err;
  }
  const auto image = read("part.exr"), other = read("cut.exr");
  ASSERT_EQ(image.layers.size(), other.layers.size());
  for (const auto& layer : image.layers) EXPECT_EQ(layer.pixels, other.find(layer.name)->pixels) << layer.name;
}

TEST_F(Merge, RefusesPartsOfOtherRenderings) {
  render("--samples 0:4", "a.exr");
  ASSERT_EQ(run("render cornell --size 40x24 --seed 6 --samples 4:8 -o seed.exr").code, 0);
  render("--samples 4:8 --max-depth 3", "depth.exr");
  ASSERT_EQ(run("render cornell --size 40x25 --seed 5 --samples 4:8 -o size.exr").code, 0);
  render("--samples 3:8", "overlap.exr");
  render("--samples 6:8", "gap.exr");
  ASSERT_EQ(run("render glossy-plates --size 40x24 --seed 5 --samples 4:8 -o scene.exr").code, 0);
  expect_refused("a.exr seed.exr", 3,
                 "seed.exr: is not a part of the same rendering as a.exr: render.seed is 6, not 5");
  expect_refused("a.exr depth.exr", 3, "path.max-depth is 3, not the default");
  expect_refused("a.exr size.exr", 3, "its size is 40x25, not 40x24");
  expect_refused("a.exr scene.exr", 3,
                 "scene.exr: is not a part of the same rendering as a.exr: its scene is 'glossy-plates'");
  expect_refused("a.exr overlap.exr", 3, "overlap.exr (samples 3:8): has samples in common with a.exr (samples 0:4)");
  expect_refused("a.exr a.exr", 3, "has samples in common");
  expect_refused("a.exr gap.exr", 3, "missing: samples 4:6;");
  expect_refused("gap.exr", 3, "missing: samples 0:6;");
  expect_refused("a.exr --spp 8", 3, "missing: samples 4:8;");
  expect_refused("a.exr --spp 2", 2, "the parts have 4 samples per pixel, not 2");
}

TEST_F(Merge, RefusesDamagedAndForeignFiles) {
  render("--samples 0:4", "a.exr");
  render("--samples 4:8", "b.exr");
  render("--spp 2", "image.exr");
  expect_refused("a.exr image.exr", 3, "image.exr: is not a part of a rendering");
  expect_refused("a.exr missing.exr", 3, "missing.exr");
  std::ofstream(folder_ / "text.exr") << "no image";
  expect_refused("a.exr text.exr", 3, "text.exr: this is not an OpenEXR file");
  const std::string bytes = slurp(folder_ / "b.exr");
  const auto write_changed = [&](const std::string& name, std::string content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  };
  for (const double length : {0.2, 0.5, 0.9, 0.999}) {
    write_changed("cut.exr", bytes.substr(0, static_cast<size_t>(length * static_cast<double>(bytes.size()))));
    expect_refused("a.exr cut.exr", 3, "cut.exr");
  }
  // A changed byte in the pixels, and one in the range of the samples. The former is in the middle of the last of 24 rows, and
  // not in a checksum of its compression, which OpenEXR ignores.
  std::string changed = bytes;
  char& pixel = changed[bytes.size() - 700];
  pixel = static_cast<char>(pixel ^ 1);
  write_changed("changed.exr", changed);
  expect_refused("a.exr changed.exr", 3, "changed.exr: it is");
  changed = bytes;
  const size_t range = changed.find("[[4,8,");
  ASSERT_NE(range, std::string::npos);
  changed[range + 4] = '9';
  write_changed("range.exr", changed);
  expect_refused("a.exr range.exr", 3, "range.exr: it is damaged");
  changed = bytes;
  const size_t version = changed.find("\"version\":\"", changed.find("etendue:part"));
  ASSERT_NE(version, std::string::npos);
  changed[version + 11] = '9';
  write_changed("version.exr", changed);
  expect_refused("a.exr version.exr", 3, "version.exr: is a part of etendue 9");
  expect_error("merge a.exr b.exr -o a.exr", 2, "a.exr is one of the parts");
}

// The scene of a part is a file, whose content counts, not its path.
TEST_F(Merge, RefusesAChangedScene) {
  ASSERT_EQ(run("save cornell -o scene.gltf").code, 0);
  fs::create_directories(folder_ / "copy");
  for (const char* file : {"scene.gltf", "scene.bin"})
    if (fs::exists(folder_ / file)) fs::copy_file(folder_ / file, folder_ / "copy" / file);
  ASSERT_EQ(run("render scene.gltf --size 24x24 --samples 0:2 -o a.exr").code, 0);
  ASSERT_EQ(run("render copy/scene.gltf --size 24x24 --samples 2:4 -o b.exr").code, 0);
  EXPECT_EQ(run("merge a.exr b.exr -o ok.exr").code, 0);
  std::ofstream(folder_ / "scene.gltf", std::ios::app) << " ";
  expect_refused("a.exr b.exr", 3, "scene.gltf: has changed since a.exr was rendered");
  ASSERT_EQ(run("render scene.gltf --size 24x24 --samples 4:6 -o c.exr").code, 0);
  expect_refused("b.exr c.exr", 3, "c.exr: is not a part of the same rendering as b.exr");
  fs::remove(folder_ / "scene.gltf");
  expect_refused("a.exr b.exr", 3, "scene.gltf");
}

TEST_F(Merge, PartsThatCannotBeRenderedSayWhy) {
  const auto refused = [&](const std::string& options, const std::string& message, const std::string& out = "p.exr") {
    expect_error(kScene + options + " -o " + out, 2, message);
    EXPECT_FALSE(fs::exists(folder_ / out)) << options;
  };
  refused("--samples 4", "'4' is not a range; give A:B");
  refused("--samples 8:4", "'8:4' is not a range");
  refused("--samples 0:9999999", "is not a range");
  refused("--region 0,0,41,2", "'0,0,41,2' is not a part of the image");
  refused("--region 0,0,0,2", "is not a part of the image");
  refused("--samples 0:4 --spp 4", "exclude each other");
  refused("--samples 0:4 --time 1", "a part has a fixed number of samples");
  refused("--samples 0:4 --aov depth", "give them to etendue merge");
  refused("--samples 0:4", "cannot hold a part", "p.png");
  refused("--samples 0:4 --integrator mlt", "mlt does not divide into samples");
  refused("--samples 0:4 --integrator pssmlt", "pssmlt does not divide into samples");
  refused("--region 0,0,8,8 --integrator bdpt", "bdpt does not divide into regions");
  refused("--samples 0:4 --integrator auto", "the automatic choice of the integrator may differ");
  refused("--samples 0:4 --set render.adaptive=rmse", "adaptive sampling does not divide");
  refused("--samples 0:4 --set film.fireflies=reweight", "fireflies does not divide");
  render("--samples 0:4", "a.exr");
  expect_error("merge a.exr --partial -o b.exr --png b.png", 2, "--partial has no --png");
  expect_error("merge a.exr --partial -o b.png", 2, "cannot hold a part");
}

// The scripts of tools/cluster, with a scheduler and a remote shell that run commands on this machine.
TEST_F(Merge, ClusterScriptsRenderAndMerge) {
  const fs::path scripts = fs::path(ETENDUE_SOURCE_DIR) / "tools" / "cluster";
  for (const auto& entry : fs::directory_iterator(scripts))
    EXPECT_EQ(std::system(("bash -n " + entry.path().string()).c_str()), 0) << entry.path();
  // sbatch: runs the tasks of an array in reverse order, and prints the number of a job.
  std::ofstream(folder_ / "sbatch") << R"(#!/usr/bin/env bash
last=none
while [ $# -gt 0 ]; do
  case $1 in
    --array=0-*) last=${1#--array=0-} ;;
    --dependency=afterok:17 | --kill-on-invalid-dep=yes | --parsable | --cpus-per-task=1) ;;
    --*) exit 9 ;;
    *) break ;;
  esac
  shift
done
if [ "$last" = none ]; then bash "$@" >&2; else
  for ((i = last; i >= 0; --i)); do
    SLURM_ARRAY_TASK_ID=$i SLURM_ARRAY_TASK_MIN=0 SLURM_ARRAY_TASK_MAX=$last SLURM_CPUS_PER_TASK=1 bash "$@" >&2
  done
fi
echo 17
)";
  std::ofstream(folder_ / "remote") << "#!/usr/bin/env bash\nshift\nexec bash -c \"$*\"\n";
  for (const char* file : {"sbatch", "remote"}) fs::permissions(folder_ / file, fs::perms::owner_all);
  render("--spp 10", "one.exr");
  const std::string environment = "cd " + folder_.string() + " && export ETENDUE=" + ETENDUE_BINARY +
                                  " PATH=" + folder_.string() +
                                  ":$PATH SSH=remote SBATCH_OPTIONS=--cpus-per-task=1 && ";
  const std::string arguments = " cornell --size 40x24 --seed 5 >log.txt 2>&1";
  EXPECT_EQ(std::system((environment + scripts.string() + "/submit.sh 3 10 array.exr" + arguments).c_str()), 0)
      << slurp(folder_ / "log.txt");
  expect_same_image("one.exr", "array.exr");
  EXPECT_EQ(
      std::system((environment + scripts.string() + "/render_over_ssh.sh 'a b b' 10 remote.exr" + arguments).c_str()),
      0)
      << slurp(folder_ / "log.txt");
  expect_same_image("one.exr", "remote.exr");
  // A lost part: the merge names it, and the same command renders it again.
  fs::remove(folder_ / "array.parts" / "part-1.exr");
  expect_refused("array.parts/part-0.exr array.parts/part-2.exr --spp 10", 3, "missing: samples 3:6;");
  fs::remove(folder_ / "array.exr");
  EXPECT_EQ(std::system((environment + scripts.string() + "/submit.sh 3 10 array.exr" + arguments).c_str()), 0);
  expect_same_image("one.exr", "array.exr");
}

}  // namespace
}  // namespace etendue::test::merge_test
