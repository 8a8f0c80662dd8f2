// Guarantees of all integrators with a preprocessing pass: images independent of the threads, resumable films, and
// prompt cancellation.
#include <gtest/gtest.h>

#include <thread>

#include "integrator/integrator.h"
#include "support/independent_estimates.h"

namespace etendue::two_pass_test {
namespace {

using test::same_bits;

struct Variant {
  const char* integrator;
  std::vector<std::pair<const char*, const char*>> settings;
};

const std::vector<Variant> kVariants{
    {"photonmap", {{"photonmap.photons", "3000"}, {"photonmap.caustic-photons", "3000"}}},
    {"photonmap", {{"photonmap.photons", "3000"}, {"photonmap.mode", "direct"}, {"photonmap.renew", "on"}}},
    {"sppm", {{"sppm.photons", "3000"}}},
    {"vcm", {{"vcm.radius", "1"}}},
    {"igi", {{"igi.light-paths", "20"}, {"igi.interleave", "3"}, {"igi.bound", "3"}}},
    {"igi", {{"igi.light-paths", "9"}, {"igi.full-bsdf", "on"}, {"igi.renew", "off"}}}};

render::Document made(const Variant& variant, const std::string& paths = "") {
  auto d = test::glossy_scene();
  d.width = 40;
  d.height = 24;
  d.method.integrator = variant.integrator;
  d.method.paths = paths;
  for (const auto& [name, value] : variant.settings) d = *render::with_text(d, name, value);
  return d;
}

TEST(TwoPass, BitIdenticalForAnyNumberOfThreads) {
  for (const Variant& variant : kVariants)
    for (const char* paths : {"", "E.*D.*L"}) {
      const auto one = test::rendered(made(variant, paths), 3, 1);
      EXPECT_GT(test::mean_of(one).value, 0) << variant.integrator;
      for (const int threads : {2, 7})
        EXPECT_TRUE(same_bits(one, test::rendered(made(variant, paths), 3, threads))) << variant.integrator;
    }
}

TEST(TwoPass, EverySamplerAndPathExpression) {
  for (const Variant& variant : kVariants)
    for (const auto& sampler : sampler_infos()) {
      auto d = made(variant);
      d.width = d.height = 8;
      d.method.sampler = sampler.name;
      const double mean = test::mean_of(test::rendered(d, 8)).value;
      auto classes = *render::with_text(d, "model.classes", "on");
      const double admitted = test::mean_of(test::rendered(classes, 8)).value;
      EXPECT_NEAR(admitted, mean, 1e-4 * mean) << variant.integrator << ' ' << sampler.name;
    }
}

TEST(TwoPass, FilmContinuesToTheSameBits) {
  for (const Variant& variant : kVariants) {
    auto d = made(variant);
    const auto whole = test::rendered(d, 7);
    auto part = test::rendered(d, 3);
    d.limits = {7, 0, 0};
    render::Session session({.threads = 2});
    session.submit(d, std::move(part));
    session.finish();
    EXPECT_TRUE(same_bits(session.film_copy(), whole)) << variant.integrator;
  }
}

// Edits at any time: the image after the last edit equals that of a session without the earlier edits.
TEST(TwoPass, CancelledPassesLeaveNoTrace) {
  for (const Variant& variant : kVariants) {
    render::Session session({.threads = 2, .interactive = true, .publish_interval = 0.01});
    auto d = made(variant);
    for (int i = 0; i < 12; ++i) {
      d.camera.to_world[3].x += 0.01f;
      session.submit(d);
      std::this_thread::sleep_for(std::chrono::milliseconds(i % 4 * 3));
    }
    d.limits = {4, 0, 0};
    d.camera.to_world[3].x += 0.01f;
    session.submit(d);
    session.finish();
    EXPECT_TRUE(same_bits(session.film_copy(), test::rendered(d, 4))) << variant.integrator;
  }
}

TEST(TwoPass, PointsAreAvailableForInspection) {
  for (const Variant& variant : kVariants) {
    auto d = made(variant);
    d.limits = {2, 0, 0};
    render::Session session({.threads = 2});
    session.submit(d);
    session.finish();
    const auto points = session.stored_points();
    ASSERT_TRUE(points) << variant.integrator;
    EXPECT_GT(points->size(), 3U) << variant.integrator;
    EXPECT_LE(points->size(), integrator::RenderState::kMostPoints);
    EXPECT_GT(session.status().memory, 0U);
  }
  render::Session session({.threads = 1});
  auto d = test::cornell(8);
  d.limits = {1, 0, 0};
  session.submit(d);
  session.finish();
  EXPECT_FALSE(session.stored_points());
}

}  // namespace
}  // namespace etendue::two_pass_test
