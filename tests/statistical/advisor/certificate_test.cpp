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
Claim claim_of(const render::Document& d, uint32_t samples) {
  render::Session session({2});
  render::Document limited = d;
  limited.limits = {samples, 0, 0};
  session.submit(limited);
  session.finish();
  const auto film = session.film_copy();
  const auto status = session.status();
  Claim claim;
  claim.document = limited;
  claim.samples = samples;
  claim.picture = film::layered_image_of(film);
  claim.certificate = advisor::certificate(
      session, limited, {film.error(), film::relative_error(film), status.rejected, session.model(), {}}, 1,
      never_cancel);
  return claim;
}

Finding judged(const Claim& claim, double seconds = 20) {
  render::Session session({2});
  return advisor::certify(session, claim, {seconds, 0}, never_cancel);
}

std::string said(const Finding& finding) {
  std::string text(advisor::verdict_name(finding.verdict));
  for (const auto& reason : finding.reasons) text += "; " + reason;
  return text;
}

std::vector<float>& pixels(Claim& claim) { return claim.picture.layers[0].pixels; }

TEST(Certificate, StatesTheNoiseOfAnUnbiasedIntegrator) {
  const Claim claim = claim_of(cornell(32), 16);
  const Certificate& c = claim.certificate;
  ASSERT_TRUE(c.rmse && c.relmse);
  EXPECT_LT(c.rmse->interval.low, c.rmse->value);
  EXPECT_GT(c.rmse->interval.high, c.rmse->value);
  EXPECT_EQ(c.bias, integrator::Bias::unbiased);
  EXPECT_TRUE(c.missing.empty());
  EXPECT_FALSE(c.model.empty());
  EXPECT_FALSE(c.khat);
}

TEST(Certificate, StatesTheLossByAPathLengthLimit) {
  const Claim claim = claim_of(changed(cornell(32), "path.max-depth", "2"), 256);
  const Certificate& c = claim.certificate;
  EXPECT_EQ(c.bias, integrator::Bias::biased);
  ASSERT_EQ(c.missing.size(), 1u);
  EXPECT_EQ(c.missing[0].paths, "EDD+L");
  const auto truth = film::radiance_of(rendered(cornell(32), 1024));
  const double rmse = metrics::metrics_of(claim.rgb(), truth).rmse;
  EXPECT_GT(rmse, c.rmse->interval.low);
  EXPECT_LT(rmse, c.rmse->interval.high);
  EXPECT_EQ(judged(claim).verdict, Verdict::confirmed) << said(judged(claim));
}

TEST(Certificate, NoUpperBoundForABiasedIntegrator) {
  const Claim claim = claim_of(changed(cornell(16), "render.integrator", "raycast"), 8);
  EXPECT_TRUE(std::isinf(claim.certificate.rmse->interval.high));
  EXPECT_GT(claim.certificate.missing_share, 0.1);
}

TEST(Certificate, PointLightsThatPathsCannotHit) {
  const Claim claim = claim_of(changed(glossy_scene_under(true, false, true, 16), "render.integrator", "path-pure"), 8);
  ASSERT_FALSE(claim.certificate.missing.empty());
  EXPECT_TRUE(std::ranges::all_of(claim.certificate.missing, &Certificate::Missing::points));
}

TEST(Certificate, RoundTripIsExact) {
  for (const char* integrator : {"path", "raycast"}) {
    const Certificate c =
        claim_of(changed(glossy_scene_under(true, false, true, 16), "render.integrator", integrator), 4).certificate;
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
      const Finding finding = judged(claim_of(d, 32));
      EXPECT_EQ(finding.verdict, Verdict::confirmed) << seed << ' ' << said(finding);
      EXPECT_NE(finding.method.find("path"), std::string::npos);
    }
}

TEST(Certify, AnEditedStatementIsRejected) {
  for (const double factor : {0.5, 2.0}) {
    Claim claim = claim_of(cornell(32), 32);
    for (auto* stated : {&claim.certificate.rmse, &claim.certificate.relmse}) {
      (*stated)->value *= factor;
      (*stated)->interval.low *= factor, (*stated)->interval.high *= factor;
    }
    EXPECT_EQ(judged(claim).verdict, Verdict::refuted);
    // Without the variance layer, which contradicts the statement, the reference alone decides.
    claim.picture.layers.resize(1);
    const Finding finding = judged(claim);
    EXPECT_EQ(finding.verdict, Verdict::refuted) << factor;
    EXPECT_GT(finding.samples, 0u);
  }
}

TEST(Certify, AnEditedRelativeErrorIsRejectedByTheVarianceLayer) {
  for (const double factor : {0.1, 10.0}) {
    Claim claim = claim_of(cornell(32), 32);
    auto& stated = *claim.certificate.relmse;
    stated = {stated.value * factor, {stated.interval.low * factor, stated.interval.high * factor}};
    const Finding finding = judged(claim);
    EXPECT_EQ(finding.verdict, Verdict::refuted) << factor;
    EXPECT_NE(said(finding).find("a relMSE of"), std::string::npos) << said(finding);
  }
}

TEST(Certify, ABiasedImageWithAHiddenBiasIsRejected) {
  const auto cut = changed(cornell(32), "path.max-depth", "2");
  Claim claim = claim_of(cut, 64);
  // The noise of the image itself, stated for an unbiased integrator.
  render::Session session({2});
  const film::Film film = rendered(cut, 64);
  const advisor::RenderStatistics evidence{film.error(), film::relative_error(film), {}, {}, {}};
  claim.certificate = advisor::certificate(session, cornell(32), evidence, 1, never_cancel);
  const Finding finding = judged(claim);
  EXPECT_EQ(finding.verdict, Verdict::refuted);
  EXPECT_TRUE(std::ranges::any_of(finding.reasons, [](const auto& r) { return r.starts_with("true RMSE"); }))
      << said(finding);
}

TEST(Certify, AFewChangedPixelsAreLocated) {
  const Claim honest = claim_of(cornell(48), 64);
  Claim claim = honest;
  // Four pixels on the floor are darkened by a fifth, which changes the total error little.
  for (const int y : {40, 41})
    for (const int x : {20, 21})
      for (size_t c = 0; c < 3; ++c) pixels(claim)[static_cast<size_t>(y * 48 + x) * 3 + c] *= 0.6f;
  const Finding finding = judged(claim);
  EXPECT_EQ(finding.verdict, Verdict::refuted);
  ASSERT_FALSE(finding.changed.empty()) << said(finding);
  EXPECT_EQ(finding.changed[0].x, 20);
  EXPECT_EQ(finding.changed[0].y, 40);
  EXPECT_LT(finding.changed[0].sigmas, 0);
}

TEST(Certify, ReportsUndecidableCases) {
  const Claim claim = claim_of(glossy_scene_under(true, true, false, 32), 1024);
  const Finding finding = judged(claim, 1e-3);
  EXPECT_EQ(finding.verdict, Verdict::undecided) << said(finding);
  EXPECT_GT(finding.seconds_needed, finding.seconds);
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
