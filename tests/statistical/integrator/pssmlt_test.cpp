// Primary sample space Metropolis light transport in all its forms, where pairwise_test.cpp does not compare it: path
// classes, opacity, closed forms, determinism and checkpoints. t-tests over blocks of pixels with a false-alarm rate of
// 1 % per test.
#include <gtest/gtest.h>

#include <cmath>

#include "support/independent_estimates.h"
#include "support/resume.h"

namespace etendue::pssmlt_test {
namespace {

using render::Document;

constexpr const char* kForms[] = {"path", "bidirectional", "multiplexed"};

Document with(const Document& d, const char* name, const std::string& value) {
  const auto changed = render::with_text(d, name, value);
  EXPECT_TRUE(changed) << name << " = " << value;
  return changed ? *changed : d;
}

Document with_integrator(const Document& d, const std::string& integrator) {
  return with(d, "render.integrator", integrator);
}
Document chains(const Document& d, const std::string& form) { return with(with_integrator(d, "pssmlt"), "form", form); }

// Few long chains explore more than many short ones.
Document metropolis(const Document& d, const std::string& form) { return with(chains(d, form), "chains", "64"); }

Document cornell() { return test::cornell(test::kSize); }

TEST(Pssmlt, LargeStepsMayBeExcludedFromTheImage) {
  const auto expected = test::replicated(with_integrator(cornell(), "path"), 512);
  for (const char* form : kForms)
    test::expect_agreement(expected, test::replicated(with(metropolis(cornell(), form), "combined", "off"), 128), form,
                           3);
}

TEST(Pssmlt, PathClassesAgree) {
  for (const char* paths : {"EL", "ED+L", "E(D|G)(D|G)L"}) {
    const Document d = with(test::glossy_scene(), "film.paths", paths);
    const auto expected = test::replicated(with_integrator(d, "path"), 256);
    for (const char* form : kForms)
      test::expect_agreement(expected, test::replicated(metropolis(d, form), 96), std::string(paths) + form, 9);
  }
}

// Leaves that transmit half of the light at random: the random decisions of a chain change with its large steps.
TEST(Pssmlt, StochasticOpacity) {
  scene::Scene scene;
  test::add(scene, test::quad(4), test::diffuse(Rgb(0.6f)));
  Material leaf = test::diffuse(Rgb(0.7f));
  leaf.alpha_mode = AlphaMode::blend;
  leaf.alpha = 0.5f;
  for (int i = 0; i < 3; ++i) {
    Mat4 place(1);
    place[3] = Vec4(0.2f * static_cast<float>(i), 0.5f + 0.4f * static_cast<float>(i), 0, 1);
    test::add(scene, test::quad(1), leaf, place);
  }
  Material light = test::diffuse(Rgb(0), Rgb(6));
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(0, 3, 1, 1);
  test::add(scene, test::quad(1), light, above);
  const Document d =
      test::document(std::move(scene), look_at({0, 2, 4}, {0, 0.4f, 0}, {0, 1, 0}, 0.7f), test::kSize, test::kSize);
  const auto expected = test::replicated(with_integrator(d, "path"), 512);
  for (const char* form : kForms) test::expect_agreement(expected, test::replicated(metropolis(d, form), 256), form, 3);
}

// Every point of the wall has the same radiance. The mean over half-buffers and seeds is within 4.5 standard errors.
TEST(Pssmlt, MeanOfTheIntegratingSphere) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kMean = kAlbedo * kShare / (1 - kAlbedo);
  for (const char* form : kForms) {
    Document d = chains(test::integrating_sphere(kShare, kAlbedo, scene::Cap::reflecting, 16), form);
    d = with(with(with(d, "max-depth", "16"), "roulette-start", "64"), "candidates", "1024");
    double sum = 0, squares = 0;
    constexpr int kRounds = 12;
    for (uint64_t seed = 0; seed < kRounds; ++seed) {
      d.seed = seed;
      const double mean = test::mean_of(test::rendered(d, 4)).value;
      sum += mean;
      squares += mean * mean;
    }
    const double mean = sum / kRounds, error = std::sqrt((squares / kRounds - mean * mean) / (kRounds - 1));
    EXPECT_NEAR(mean, kMean, 4.5 * error + 2e-4 * kMean) << form;
    EXPECT_LT(error, 0.04 * kMean) << form;
  }
}

TEST(Pssmlt, BlackSceneStaysBlackAndEnds) {
  scene::Scene scene;
  test::add(scene, test::quad(4), test::diffuse(Rgb(0.6f)));
  const Document d = test::document(std::move(scene), look_at({0, 2, 4}, {0, 0, 0}, {0, 1, 0}, 0.7f), 16, 16);
  for (const char* form : kForms) EXPECT_EQ(test::mean_of(test::rendered(chains(d, form), 4)).value, 0) << form;
}

Document several_groups(const std::string& form) {
  Document d = with(chains(cornell(), form), "chains", "700");
  d.width = 70;
  d.height = 50;
  return with(d, "candidates", "300");  // several epochs
}

TEST(Pssmlt, BitIdenticalForAnyNumberOfThreads) {
  for (const char* form : kForms) {
    const Document d = several_groups(form);
    const auto one = test::rendered(d, 4, 1);
    for (const int threads : {2, 7}) test::expect_same_bits(one, test::rendered(d, 4, threads), form);
  }
}

TEST(Pssmlt, ResumesToTheSameBits) {
  for (const char* form : kForms) test::expect_same_bits_after_resume(several_groups(form), form);
}

// A film without the state of its chains continues with new chains.
TEST(Pssmlt, FilmWithoutChainsContinuesWithNewChains) {
  Document d = with(several_groups("path"), "candidates", "20000");
  const auto cut = test::rendered(d, 4), whole = test::rendered(d, 8);
  d.limits = {8, 0, 0};
  render::Session session({.threads = 2});
  session.submit(d, cut);
  session.finish();
  const auto other = session.film_copy();
  EXPECT_EQ(other.samples(0, 0), 8u);
  EXPECT_NEAR(test::mean_of(other).value, test::mean_of(whole).value, 0.1 * test::mean_of(whole).value);
  size_t lit = 0, same = 0;
  for (size_t i = 0; i < whole.pixels().size(); ++i) {
    if (whole.pixels()[i].sum == film::Film(1, 1).pixels()[0].sum) continue;
    ++lit;
    same += whole.pixels()[i].sum == other.pixels()[i].sum ? 1 : 0;
  }
  EXPECT_GT(lit, 1000u);
  EXPECT_LT(same, lit / 10);
}

TEST(Pssmlt, ReportsTheAcceptanceRate) {
  Document d = several_groups("multiplexed");
  d.limits = {6, 0, 0};
  render::Session session({.threads = 2});
  session.submit(d);
  session.finish();
  const auto statistics = session.status().statistics;
  ASSERT_EQ(statistics.size(), 2u);
  for (const auto& s : statistics) {
    EXPECT_EQ(s.unit, "%");
    EXPECT_GT(s.value, 1) << s.name;
    EXPECT_LT(s.value, 99) << s.name;
  }
}

}  // namespace
}  // namespace etendue::pssmlt_test
