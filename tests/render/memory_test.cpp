// What methods keep while they render: shown in the status, and bounded however long that takes.
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

// Lists find their size with the first samples; chains go on to longer paths now and then.
TEST(Memory, OfNoMethodGrowsWithTheSamples) {
  for (const auto& info : integrator::integrator_infos()) {
    const size_t early = memory_after(info.name, 32), late = memory_after(info.name, 128);
    EXPECT_GT(early, 0u) << info.name;
    EXPECT_LT(static_cast<double>(late), 1.2 * static_cast<double>(early)) << info.name;
  }
}

// Photons are counted: 32 bytes for each that is stored. At least every third is, and none more than twenty times.
TEST(Memory, OfPhotonsIsShown) {
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
