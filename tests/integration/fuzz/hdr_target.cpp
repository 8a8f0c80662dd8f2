// Radiance HDR.
#include "integration/fuzz/image_run.h"

namespace etendue::fuzz {
namespace {

void run(Input input) { decode(input, "hdr"); }

std::vector<Bytes> images() {
  using namespace std::string_view_literals;
  std::vector<Bytes> seeds;
  // Flat pixels, old run-length encoding, new run-length encoding.
  for (const std::string_view rows :
       {"-Y 2 +X 2\n\x10\x20\x30\x80\x40\x50\x60\x81\x01\x02\x03\x7f\x00\x00\x00\x00"sv,
        "-Y 1 +X 9\n\x10\x20\x30\x80\x01\x01\x01\x08"sv,
        "-Y 1 +X 8\n\x02\x02\x00\x08\x88\x10\x88\x20\x04\x01\x02\x03\x04\x84\x05\x88\x80"sv})
    seeds.push_back(bytes_of("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + std::string(rows)));
  return seeds;
}

}  // namespace

const Target kTarget{.run = run, .seeds = images};

}  // namespace etendue::fuzz
