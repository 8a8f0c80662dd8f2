// OpenEXR.
#include "base/file.h"
#include "image/image.h"
#include "integration/fuzz/image_run.h"
#include "unit/image/file_bytes.h"

namespace etendue::fuzz {
namespace {

void run(Input input) { decode(input, "exr"); }

// With ZIP compression, two layers and an attribute.
Bytes compressed() {
  const test::TemporaryFile file("seed.exr");
  const image::LayeredImage image{
      .width = 4,
      .height = 3,
      .layers = {{"", {"R", "G", "B"}, std::vector<float>(36, 0.5f)}, {"depth", {"Z"}, std::vector<float>(12, 2)}},
      .attributes = {{"etendue:state", "{}"}}};
  require(static_cast<bool>(image::write_exr(file.path(), image)), "a seed cannot be written as OpenEXR");
  const auto bytes = read_file(file.path());
  require(static_cast<bool>(bytes), "a seed cannot be read");
  return *bytes;
}

std::vector<Bytes> images() {
  using test::sample;
  const test::ExrChannel half{"A", test::ExrType::half, std::vector<test::FileBytes>(4, sample(uint16_t{0x3c00}))};
  const test::ExrChannel number{"R", test::ExrType::float32, std::vector<test::FileBytes>(4, sample(0.5f))};
  return {compressed(), bytes_of(test::exr_file({half, number}, {0, 0, 1, 1}, {-1, 0, 2, 1}))};
}

}  // namespace

const Target kTarget{.run = run, .seeds = images};

}  // namespace etendue::fuzz
