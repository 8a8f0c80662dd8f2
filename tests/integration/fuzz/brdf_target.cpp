// Tables of measured BRDFs: BRDF tables, MERL and RGL files. What is read is evaluated and sampled.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "bsdf/measured/measured_data.h"
#include "integration/fuzz/memory_file.h"
#include "support/rgl_bytes.h"

namespace etendue::fuzz {
namespace {

const Vec3 kDirections[] = {Vec3(0, 0, 1), glm::normalize(Vec3(1, 0.2f, 0.5f)),
                            glm::normalize(Vec3(-0.3f, 0.8f, 0.1f))};

template <class Brdf>
void evaluate(const Brdf& brdf) {
  for (const Vec3& o : kDirections)
    for (const Vec3& i : kDirections) {
      const Rgb value = brdf.f(o, i);
      require(value.r >= 0 && value.g >= 0 && value.b >= 0, "a BRDF is negative or not a number");
    }
}

void sample(const RglBrdf& brdf) {
  for (const Vec3& o : kDirections) {
    Vec3 i;
    if (brdf.sample_direction(o, LobeRandom(0, Vec2(0.3f, 0.7f)), i) && i.z > 0)
      require(brdf.density(o, i) >= 0, "a density is negative or not a number");
  }
}

void read(Input input) {
  const auto table = BrdfTable::parse(std::string(text_of(input)), "input");
  if (table) return evaluate(*table);
  const MemoryFile file(input);
  if (const auto merl = MerlBrdf::read(file.path())) return evaluate(*merl);
  if (const auto rgl = RglBrdf::read(file.path())) {
    evaluate(*rgl);
    sample(*rgl);
  }
}

template <class T>
void append(Bytes& out, const T& value) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&value);
  out.insert(out.end(), bytes, bytes + sizeof value);
}

Bytes merl() {
  Bytes file;
  for (const int32_t size : {2, 3, 4}) append(file, size);
  for (int k = 0; k < 3 * 2 * 3 * 4; ++k) append(file, 0.5 * k);
  return file;
}

Bytes rgl() {
  const auto bytes = test::rgl_bytes(0.3f, 0.7f);
  return bytes_of({bytes.data(), bytes.size()});
}

std::vector<Bytes> tables() {
  return {bytes_of("etendue-brdf 1\n# grey\nisotropic 1 2\n0.1 0.1 0.1\n0.2 0.2 0.2\n"),
          bytes_of("etendue-brdf 1\nanisotropic 1 2\n0 0.1 2e-3\n1 1 1\n0.5 0.5 0.5\n0.1 0.1 0.1\n"), merl(), rgl()};
}

}  // namespace

const Target kTarget{.run = read, .seeds = tables};

}  // namespace etendue::fuzz
