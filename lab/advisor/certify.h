// Verification of an image's certificate by an independent rendering.
//
// The image is rendered again with other random numbers by an unbiased integrator that finds all paths any integrator
// finds, and the true error of the image is estimated from both (true_error.h). The certificate is refuted if that
// error lies outside the interval that holds for 999 of 1000 correct certificates, if its parts contradict each other,
// or if blocks of pixels were modified (block_test.h).
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "advisor/block_test.h"
#include "advisor/certificate.h"
#include "advisor/true_error.h"
#include "image/image.h"

namespace etendue::advisor {

// An image file with the settings and the certificate stored in it.
struct CertifiedImage {
  render::Document document;
  uint32_t samples = 0;
  image::LayeredImage image;
  Certificate certificate;

  std::span<const float> rgb() const { return image.find("")->pixels; }
  std::span<const float> variance() const;  // of each value; empty if unknown
};

// Reads an .exr written by this program. Anything else is an input error, as is a file whose size differs from its
// settings or that has pixels which are not finite.
Result<CertifiedImage> read_certified_image(const std::string& file);

// consistent: the true error is known less precisely than a confirmation requires, and does not contradict the
// statement. undecided: there was no time for a comparison.
enum class Verdict { confirmed, consistent, refuted, undecided };
// "stands", "consistent", "does not stand" or "cannot tell", as in the JSON output.
std::string_view verdict_name(Verdict verdict);

struct CertificationResult {
  Verdict verdict = Verdict::undecided;
  std::vector<std::string> reasons;  // sentences
  std::string method;                // the method of the independent rendering
  uint32_t samples = 0;
  double seconds = 0;  // rendering time
  // The true error of the image; the intervals cover three standard errors on either side.
  IntervalEstimate rmse, relmse;
  std::vector<Block> changed;
  double seconds_needed = 0;  // approximate total time until a confirmation, if consistent or undecided
  bool interrupted = false;
};

struct CertifyOptions {
  double seconds = 10;  // maximum rendering time; less time gives a weaker statement
  uint64_t seed = 0;    // selects other random numbers for the independent rendering
  // Receives the time in seconds that a confirmation is expected to take, once the first samples have been timed.
  std::function<void(double seconds)> on_estimate = {};
};

// Returns as soon as a verdict is reached.
CertificationResult certify(render::Session& session, const CertifiedImage& image, const CertifyOptions& options,
                            const bench::Progress& progress);

}  // namespace etendue::advisor
