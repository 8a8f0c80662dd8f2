// Photometric files. What is read is evaluated and sampled.
#include "integration/fuzz/target.h"
#include "light/photometry_reader.h"

namespace etendue::fuzz {
namespace {

void read(Input input) {
  const auto profile = parse_photometry(text_of(input), "input");
  if (!profile) return;
  require(profile->flux() >= 0 && profile->flux() < kInfinity, "a flux is negative or not a number");
  require(profile->direction_pdf() > 0 && profile->direction_pdf() < kInfinity, "a density is not positive");
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 8; ++k) {
      const Vec3 d = profile->sample_direction(Vec2(i, k) / 7.01f);
      require(std::abs(glm::length(d) - 1) < 1e-3f, "a direction is not a unit vector");
      require(profile->intensity(d) >= 0, "an intensity is negative or not a number");
    }
}

std::vector<Bytes> files() {
  return {
      bytes_of("TILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n9 5 0\n"),
      bytes_of("IESNA91\n[A] b\nTILT=INCLUDE\n1\n2\n0 90\n1 0.9\n1 9 2 2 2 1 1 0 0 0 1 1 9\n0 180\n0 90\n1 2 3 4\n"),
      bytes_of("TILT=NONE\n1 1 1 2 3 2 1 0 0 0 1 1 1\n-90 90\n0 45 90\n1 2 3 4 5 6\n"),
      bytes_of("TILT=NONE\n1 1 1 2 2 3 1 0 0 0 1 1 1\n0 90\n-90 90\n1,2,3,4\n")};
}

}  // namespace

const Target kTarget{.run = read, .seeds = files};

}  // namespace etendue::fuzz
