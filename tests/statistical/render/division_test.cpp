// Parts of a rendering, stored and merged, have the bits of one run. No random comparison is made: equality is exact.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "integrator/integrator_info.h"
#include "render/checkpoint.h"
#include "render/division.h"
#include "render/partial_result.h"
#include "support/scenes.h"

namespace etendue::test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 45, kHeight = 21;  // tiles at the right and lower boundary are cut
constexpr uint32_t kSamples = 13;

class Division : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("etendue-division-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

// Small photon maps and meshes, which make the test fast.
render::Document cornell_with(const std::string& integrator) {
  render::Document d = cornell(kWidth);
  d.height = kHeight;
  d.method.integrator = integrator;
  for (const char* setting : {"photonmap.photons", "photonmap.caustic-photons", "sppm.photons"})
    d = *with_text(d, setting, "500");
  return *with_text(d, "radiosity.patches", "200");
}

struct Part {
  uint32_t first, end;
  std::optional<render::PixelRect> region = {};
};

render::PartialSamples rendered_part(render::Document d, const Part& part, int threads) {
  d.limits = {part.end - part.first, 0, 0};
  d.part = {part.first, part.region};
  render::Session session({.threads = threads});
  session.submit(d);
  session.finish();
  return {session.film_copy(), session.tail_states()};
}

render::PartialSamples no_samples() {
  render::PartialSamples samples{film::Film(kWidth, kHeight), {}};
  samples.tails.resize(render::TailStatistics::tile_count(kWidth, kHeight));
  return samples;
}

fs::path stored(const fs::path& file, const render::PartialSamples& samples, const std::vector<Part>& parts) {
  render::PartInfo info{.state = "{}", .version = "1", .width = kWidth, .height = kHeight};
  for (const Part& p : parts)
    info.blocks.push_back({p.first, p.end, p.region.value_or(render::PixelRect{0, 0, kWidth, kHeight})});
  const auto written = render::write_part(file, info, samples);
  EXPECT_TRUE(written) << written.error().message;
  return file;
}

void add_file(const fs::path& file, render::PartialSamples& samples) {
  const auto info = render::read_part_info(file);
  ASSERT_TRUE(info) << info.error().message;
  const auto part = render::load_part(file, *info);
  ASSERT_TRUE(part) << part.error().message;
  render::add_part(*part, *info, samples);
}

void expect_same_image(const film::Film& a, const film::Film& b, const std::string& what) {
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      for (const uint32_t half : {0U, 1U}) {
        ASSERT_EQ(a.half_buffer_samples(x, y, half), b.half_buffer_samples(x, y, half)) << what << x << ' ' << y;
        ASSERT_EQ(a.sum(x, y, half), b.sum(x, y, half)) << what << ' ' << x << ' ' << y;
      }
      ASSERT_EQ(a.mean(x, y), b.mean(x, y)) << what;
      ASSERT_EQ(a.variance_of_mean(x, y), b.variance_of_mean(x, y)) << what;
    }
  EXPECT_EQ(a.error().rmse, b.error().rmse) << what;
}

// Stores the parts, and merges them in random order and as a group of the first half and the rest.
void expect_merged(const fs::path& folder, const render::Document& d, std::vector<Part> parts, const film::Film& whole,
                   const std::string& what) {
  std::mt19937 engine(1);
  std::ranges::shuffle(parts, engine);
  std::vector<fs::path> files;
  for (size_t i = 0; i < parts.size(); ++i)
    files.push_back(
        stored(folder / (std::to_string(i) + ".exr"), rendered_part(d, parts[i], i % 2 == 0 ? 1 : 2), {parts[i]}));
  auto merged = no_samples(), group = no_samples(), grouped = no_samples();
  for (const auto& file : files) add_file(file, merged);
  expect_same_image(whole, merged.film, what);
  const size_t half = files.size() / 2;
  for (size_t i = 0; i < half; ++i) add_file(files[i], group);
  const auto group_file =
      stored(folder / "group.exr", group, {parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(half)});
  for (size_t i = files.size(); i-- > half;) add_file(files[i], grouped);
  add_file(group_file, grouped);
  expect_same_image(whole, grouped.film, what + " grouped");
  EXPECT_EQ(merged.tails, grouped.tails) << what;
}

std::vector<Part> seven_parts() { return {{0, 1}, {1, 2}, {2, 5}, {5, 6}, {6, 10}, {10, 11}, {11, kSamples}}; }

// Two parts of all samples, and three of the lower left, one of which is a range of samples.
std::vector<Part> region_parts() {
  const render::PixelRect right{13, 0, kWidth - 13, kHeight}, top{0, 0, 13, 17}, bottom{0, 17, 13, kHeight - 17};
  return {{0, kSamples, right}, {0, 4, top}, {4, kSamples, top}, {0, kSamples, bottom}};
}

TEST_F(Division, MergedPartsHaveTheBitsOfOneRun) {
  for (const auto& info : integrator::integrator_infos()) {
    if (info.division.unit == integrator::DivisionUnit::none) continue;
    // Light paths of the whole image contribute to a region.
    EXPECT_FALSE(info.division.regions && info.accumulation >= integrator::Accumulation::with_splats) << info.name;
    const render::Document d = cornell_with(info.name);
    const film::Film whole = rendered(d, kSamples, 2);
    expect_merged(folder_, d, {{0, 6}, {6, kSamples}}, whole, info.name + ", halves");
    expect_merged(folder_, d, seven_parts(), whole, info.name + ", seven parts");
    if (info.division.regions) expect_merged(folder_, d, region_parts(), whole, info.name + ", regions");
  }
}

// Every sampler: its points depend on the number of a sample, not on the samples before.
TEST_F(Division, EverySamplerDivides) {
  for (const auto& sampler : sampler_infos()) {
    render::Document d = cornell_with("path");
    d.method.sampler = sampler.name;
    expect_merged(folder_, d, seven_parts(), rendered(d, kSamples, 2), sampler.name);
  }
}

// Samples from 1e-25 to 1e12 times those of the Cornell box need more bits than a double.
TEST_F(Division, SumsOfAnyMagnitudeAreMerged) {
  std::vector<render::PartialSamples> parts{no_samples(), no_samples(), no_samples()};
  auto whole = no_samples();
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> magnitude(-25, 12);
  for (uint32_t s = 0; s < 60; ++s)
    for (int x = 0; x < kWidth; ++x) {
      const Rgb radiance(std::pow(10.0f, magnitude(engine)), std::pow(10.0f, magnitude(engine)), 0);
      whole.film.add(x, 2, s % 2, radiance);
      parts[s % 3].film.add(x, 2, s % 2, radiance);
    }
  auto merged = no_samples();
  for (uint32_t i : {2U, 0U, 1U}) add_file(stored(folder_ / "p.exr", parts[i], {{i, i + 1}}), merged);
  for (int x = 0; x < kWidth; ++x) {
    ASSERT_EQ(whole.film.mean(x, 2), merged.film.mean(x, 2));
    for (const uint32_t half : {0U, 1U}) ASSERT_EQ(whole.film.sum(x, 2, half), merged.film.sum(x, 2, half));
  }
}

TEST_F(Division, CheckpointsKeepTheRoundingErrorsAndTheirEarlierVersionIsRead) {
  auto samples = no_samples();
  samples.film.add(1, 1, 0, Rgb(1e12f));
  samples.film.add(1, 1, 0, Rgb(1e-12f));
  const fs::path file = folder_ / "checkpoint";
  ASSERT_TRUE(render::write_checkpoint(file, {.state = "{}", .film = samples.film}));
  auto read = render::read_checkpoint(file);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->film.rounding_errors().bytes(), samples.film.rounding_errors().bytes());

  // The header of version 4 has no size of the statistics of tails, and that of version 3 no size of rounding errors either.
  ASSERT_TRUE(render::write_checkpoint(file, {.state = "{}", .film = film::Film(kWidth, kHeight)}));
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  constexpr size_t kHeader = 96;
  for (const auto& [version, shorter] : {std::pair<char, size_t>{'4', 8}, {'3', 16}}) {
    std::string earlier = bytes;
    earlier[7] = version;
    earlier.erase(kHeader - shorter, shorter);
    std::ofstream(file, std::ios::binary) << earlier;
    read = render::read_checkpoint(file);
    ASSERT_TRUE(read) << version << ": " << read.error().message;
    EXPECT_EQ(read->state, "{}");
  }
}

// A part that is stored after three of its samples continues with the fourth.
TEST_F(Division, PartsContinueFromCheckpoints) {
  for (const std::string integrator : {"path", "bdpt", "sppm"}) {
    render::Document d = cornell_with(integrator);
    const auto whole = rendered_part(d, {3, 10}, 2);
    auto first = rendered_part(d, {3, 6}, 2);
    d.part.first_sample = 3;
    d.limits = {7, 0, 0};
    const fs::path file = folder_ / "checkpoint";
    ASSERT_TRUE(render::write_checkpoint(file, {.state = state_json(d, 3), .film = std::move(first.film)}));
    auto read = render::read_checkpoint(file);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(render::part_from_state(read->state), d.part);
    render::Session session({.threads = 2});
    session.submit(d, std::move(read->film));
    session.finish();
    expect_same_image(whole.film, session.film_copy(), integrator);
  }
}

TEST_F(Division, DocumentsThatDoNotDivideSayWhy) {
  const auto reason = [](const render::Document& d) { return render::division_incompatibility(d); };
  render::Document d = cornell_with("path");
  EXPECT_EQ(reason(d), "");
  d.method.adaptive = render::Adaptive::rmse;
  EXPECT_NE(reason(d).find("adaptive sampling does not divide"), std::string::npos);
  EXPECT_NE(reason(cornell_with("mlt")).find("mlt does not divide into samples, because the Markov chains"),
            std::string::npos);
  d = cornell_with("bdpt");
  EXPECT_EQ(reason(d), "");
  d.part.region = render::PixelRect{0, 0, 8, 8};
  EXPECT_NE(reason(d).find("bdpt does not divide into regions"), std::string::npos);
  d = cornell_with("path");
  d.fireflies = film::Fireflies::reweight;
  EXPECT_NE(reason(d).find("re-weighting of fireflies"), std::string::npos);
}

}  // namespace
}  // namespace etendue::test
