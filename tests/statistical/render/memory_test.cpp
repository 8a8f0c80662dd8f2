// Memory of integrators during rendering: reported in the status, and bounded for any number of samples.
#include <gtest/gtest.h>

#include "integrator/integrator.h"
#include "render/session.h"
#include "support/scenes.h"

namespace etendue {
namespace {

size_t memory_after(const std::string& integrator, uint32_t samples) {
  auto d = *render::new_document("cornell-spheres");
  d.width = d.height = 32;
  d = *render::with_text(d, "render.integrator", integrator);
  d.limits = {samples, 0, 0};
  render::Session session({.threads = 1});
  session.submit(d);
  session.finish();
  return session.status().memory;
}

// Memory beyond the scene and the film, which `path` needs as well. Storage per vertex of the longest path grows with
// the logarithm of the number of samples; storage per sample would grow by a factor of four.
TEST(Memory, IsIndependentOfTheNumberOfSamples) {
  constexpr double kLittle = 1 << 16;
  const auto base = static_cast<double>(memory_after("path", 32));
  for (const auto& info : integrator::integrator_infos()) {
    const double early = static_cast<double>(memory_after(info.name, 32)) - base,
                 late = static_cast<double>(memory_after(info.name, 128)) - base;
    EXPECT_LT(late, 2 * early + kLittle) << info.name;
  }
}

// Photons use 32 bytes each. The bound allows between a third and twenty stored photons per emitted photon.
TEST(Memory, OfPhotonsIsReported) {
  auto d = test::cornell(16);
  const auto memory = [&](int photons) {
    d = *render::with_text(*render::with_text(d, "render.integrator", "sppm"), "photons", std::to_string(photons));
    d.limits = {2, 0, 0};
    render::Session session({.threads = 1});
    session.submit(d);
    session.finish();
    return static_cast<double>(session.status().memory);
  };
  const double few = memory(1000), many = memory(101000);
  EXPECT_GT(many - few, 32 * 100000 / 3.0);
  EXPECT_LT(many - few, 32 * 100000 * 20.0);
}

}  // namespace
}  // namespace etendue
