// Certificates of images: they hold for unmodified images, and modified images are detected.
#include "advisor/certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "advisor/certify.h"
#include "film/film_image.h"
#include "metrics/metrics.h"
#include "statistical/advisor/test_scenes.h"

namespace etendue::test {
namespace {

using advisor::Certificate;
using advisor::CertificationResult;
using advisor::CertifiedImage;
using advisor::Verdict;

// A rendering with its certificate, as written by `etendue render`.
CertifiedImage certified_image(const render::Document& d, uint32_t samples) {
  render::Session session({2});
  render::Document limited = d;
  limited.limits = {samples, 0, 0};
  session.submit(limited);
  session.finish();
  const auto film = session.film_copy();
  const auto status = session.status();
  CertifiedImage image;
  image.document = limited;
  image.samples = samples;
  image.image = film::layered_image_of(film);
  image.certificate = advisor::certificate(
      session, limited, {film.error(), film::relative_error(film), status.rejected, session.model(), {}}, 1,
      never_cancel);
  return image;
}

CertificationResult certification(const CertifiedImage& image, double seconds = 20) {
  render::Session session({2});
  return advisor::certify(session, image, {seconds, 0}, never_cancel);
}

std::string text_of(const CertificationResult& result) {
  std::string text(advisor::verdict_name(result.verdict));
  for (const auto& reason : result.reasons) text += "; " + reason;
  return text;
}

std::vector<float>& pixels(CertifiedImage& image) { return image.image.layers[0].pixels; }

TEST(Certificate, StatesTheNoiseOfAnUnbiasedIntegrator) {
  const CertifiedImage image = certified_image(cornell(32), 16);
  const Certificate& c = image.certificate;
  ASSERT_TRUE(c.rmse && c.relmse);
  EXPECT_LT(c.rmse->interval.low, c.rmse->value);
  EXPECT_GT(c.rmse->interval.high, c.rmse->value);
  EXPECT_EQ(c.bias, integrator::Bias::unbiased);
  EXPECT_TRUE(c.missing.empty());
  EXPECT_FALSE(c.model.empty());
  EXPECT_FALSE(c.khat);
}

TEST(Certificate, StatesTheLossByAPathLengthLimit) {
  const CertifiedImage image = certified_image(changed(cornell(32), "path.max-depth", "2"), 256);
  const Certificate& c = image.certificate;
  EXPECT_EQ(c.bias, integrator::Bias::biased);
  ASSERT_EQ(c.missing.size(), 1u);
  EXPECT_EQ(c.missing[0].paths, "EDD+L");
  const auto truth = film::radiance_of(rendered(cornell(32), 1024));
  const double rmse = metrics::metrics_of(image.rgb(), truth).rmse;
  EXPECT_GT(rmse, c.rmse->interval.low);
  EXPECT_LT(rmse, c.rmse->interval.high);
  EXPECT_EQ(certification(image).verdict, Verdict::confirmed) << text_of(certification(image));
}

TEST(Certificate, NoUpperBoundForABiasedIntegrator) {
  const CertifiedImage image = certified_image(changed(cornell(16), "render.integrator", "raycast"), 8);
  EXPECT_TRUE(std::isinf(image.certificate.rmse->interval.high));
  EXPECT_GT(image.certificate.missing_share, 0.1);
}

TEST(Certificate, PointLightsThatPathsCannotHit) {
  const CertifiedImage image =
      certified_image(changed(glossy_scene_under(true, false, true, 16), "render.integrator", "path-pure"), 8);
  ASSERT_FALSE(image.certificate.missing.empty());
  EXPECT_TRUE(std::ranges::all_of(image.certificate.missing, &Certificate::Missing::from_point_lights));
}

TEST(Certificate, RoundTripIsExact) {
  for (const char* integrator : {"path", "raycast"}) {
    const Certificate c =
        certified_image(changed(glossy_scene_under(true, false, true, 16), "render.integrator", integrator), 4)
            .certificate;
    const auto again = advisor::certificate_from_json(advisor::certificate_json(c), "test");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(advisor::certificate_json(*again), advisor::certificate_json(c));
    EXPECT_EQ(again->rmse->interval.high, c.rmse->interval.high);
  }
  for (const char* wrong : {"", "{}", "[1]", "{\"bias\":3}"}) {
    const auto none = advisor::certificate_from_json(wrong, "a.exr");
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().fault, Fault::input);
  }
}

TEST(Certify, UnmodifiedImagesPass) {
  // One true statement in a thousand is rejected by its error, and one by its blocks. Eight statements give one false
  // alarm in sixty runs.
  for (uint64_t seed = 1; seed <= 4; ++seed)
    for (auto d : {cornell(32), glossy_scene_under(true, true, false, 32)}) {
      d.seed = seed;
      const CertificationResult result = certification(certified_image(d, 32));
      EXPECT_EQ(result.verdict, Verdict::confirmed) << seed << ' ' << text_of(result);
      EXPECT_NE(result.method.find("path"), std::string::npos);
    }
}

TEST(Certify, AnEditedStatementIsRejected) {
  for (const double factor : {0.5, 2.0}) {
    CertifiedImage image = certified_image(cornell(32), 32);
    for (auto* stated : {&image.certificate.rmse, &image.certificate.relmse}) {
      (*stated)->value *= factor;
      (*stated)->interval.low *= factor, (*stated)->interval.high *= factor;
    }
    EXPECT_EQ(certification(image).verdict, Verdict::refuted);
    // Without the variance layer, which contradicts the statement, the reference alone decides.
    image.image.layers.resize(1);
    const CertificationResult result = certification(image);
    EXPECT_EQ(result.verdict, Verdict::refuted) << factor;
    EXPECT_GT(result.samples, 0u);
  }
}

TEST(Certify, AnEditedRelativeErrorIsRejectedByTheVarianceLayer) {
  for (const double factor : {0.1, 10.0}) {
    CertifiedImage image = certified_image(cornell(32), 32);
    auto& stated = *image.certificate.relmse;
    stated = {stated.value * factor, {stated.interval.low * factor, stated.interval.high * factor}};
    const CertificationResult result = certification(image);
    EXPECT_EQ(result.verdict, Verdict::refuted) << factor;
    EXPECT_NE(text_of(result).find("a relMSE of"), std::string::npos) << text_of(result);
  }
}

TEST(Certify, ABiasedImageWithAHiddenBiasIsRejected) {
  const auto cut = changed(cornell(32), "path.max-depth", "2");
  CertifiedImage image = certified_image(cut, 64);
  // The noise of the image itself, stated for an unbiased integrator.
  render::Session session({2});
  const film::Film film = rendered(cut, 64);
  const advisor::RenderStatistics evidence{film.error(), film::relative_error(film), {}, {}, {}};
  image.certificate = advisor::certificate(session, cornell(32), evidence, 1, never_cancel);
  const CertificationResult result = certification(image);
  EXPECT_EQ(result.verdict, Verdict::refuted);
  EXPECT_TRUE(std::ranges::any_of(result.reasons, [](const auto& r) { return r.starts_with("true RMSE"); }))
      << text_of(result);
}

TEST(Certify, AFewChangedPixelsAreLocated) {
  const CertifiedImage honest = certified_image(cornell(48), 64);
  CertifiedImage image = honest;
  // Four pixels on the floor are darkened by a fifth, which changes the total error little.
  for (const int y : {40, 41})
    for (const int x : {20, 21})
      for (size_t c = 0; c < 3; ++c) pixels(image)[static_cast<size_t>(y * 48 + x) * 3 + c] *= 0.6f;
  const CertificationResult result = certification(image);
  EXPECT_EQ(result.verdict, Verdict::refuted);
  ASSERT_FALSE(result.changed.empty()) << text_of(result);
  EXPECT_EQ(result.changed[0].x, 20);
  EXPECT_EQ(result.changed[0].y, 40);
  EXPECT_LT(result.changed[0].sigmas, 0);
}

// The shortest time limit, a millisecond, is not enough for two samples of each of half a million pixels.
TEST(Certify, ReportsUndecidableCases) {
  const CertifiedImage image = certified_image(glossy_scene_under(true, true, false, 720), 2);
  const CertificationResult result = certification(image, 0);
  EXPECT_EQ(result.verdict, Verdict::undecided) << text_of(result);
  EXPECT_LT(result.samples, film::kHalfBuffers);
  EXPECT_GT(result.seconds_needed, result.seconds);
}

// An error needs two samples per pixel; an image with one states none, which is no contradiction.
TEST(Certify, AnImageOfOneSampleIsUndecided) {
  const CertificationResult result = certification(certified_image(cornell(32), 1));
  EXPECT_EQ(result.verdict, Verdict::undecided);
  ASSERT_EQ(result.reasons.size(), 1u);
  EXPECT_NE(result.reasons[0].find("one sample per pixel"), std::string::npos) << result.reasons[0];
}

// The comparison waits for the next doubling of the samples; the announced time counts with it.
TEST(Certify, TheSamplesOfTheImageAreDoubledUp) {
  double announced = 0;
  advisor::CertifyOptions options;
  options.seconds = 100;
  options.on_estimate = [&](double seconds) { announced = seconds; };
  render::Session session({1});
  const auto result = advisor::certify(session, certified_image(cornell(32), 20), options, never_cancel);
  EXPECT_EQ(result.verdict, Verdict::confirmed) << text_of(result);
  EXPECT_GE(result.samples, 32u);
  EXPECT_GT(announced, 0);
}

// The error of a known image. The noise of the reference rendering is not subtracted.
TEST(TrueError, WorksWithoutAnExactReference) {
  const auto d = cornell(32);
  auto other = d;
  other.seed = 9;
  const auto picture = film::radiance_of(rendered(d, 8));
  const auto exact = metrics::metrics_of(picture, film::radiance_of(rendered(other, 4096)));
  other.seed = 10;
  const auto rough = advisor::true_error(picture, rendered(other, 64));
  EXPECT_NEAR(rough.absolute.value, exact.mse, 4 * rough.absolute.standard_error + 0.02 * exact.mse);
  EXPECT_LT(rough.absolute.standard_error, 0.3 * exact.mse);
}

}  // namespace
}  // namespace etendue::test
