#include "integration/fuzz/gltf_run.h"

#include <array>

#include "integration/fuzz/memory_file.h"
#include "render/session.h"

namespace etendue::fuzz {

void open_and_render(Input input) {
  constexpr int kSize = 8;
  constexpr uint64_t kLoadedPerRendered = 8;
  static constexpr std::array kIntegrators = {"path", "bdpt"};
  const MemoryFile file(input);
  auto document = render::new_document(file.path());
  const uint64_t number = number_of(input);
  if (!document || number % kLoadedPerRendered != 0) return;
  document->width = document->height = kSize;
  document->method.integrator = kIntegrators[number / kLoadedPerRendered % kIntegrators.size()];
  const film::InvalidSamples invalid = render::rendered(*document, 1, 1).invalid_samples();
  require(invalid.nan == 0, "a sample is not a number");
  require(invalid.infinite == 0, "a sample is infinite");
  require(invalid.negative == 0, "a sample is negative");
}

}  // namespace etendue::fuzz
