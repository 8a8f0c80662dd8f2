// Verification of an image's certificate by an independent rendering.
//
// The image is rendered again with other random numbers by an unbiased integrator that finds all paths any integrator
// finds, and the true error of the image is estimated from both (true_error.h). The certificate is refuted if that
// error lies outside the interval that holds for 999 of 1000 correct certificates, if its parts contradict each other,
// or if blocks of pixels were modified (block_test.h).
#pragma once
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

enum class Verdict { confirmed, refuted, undecided };
// "stands", "does not stand" or "cannot tell", as in the JSON output.
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
  double seconds_needed = 0;  // approximate total time until a verdict, if undecided
  bool interrupted = false;
};

struct CertifyOptions {
  double seconds = 10;  // maximum rendering time
  uint64_t seed = 0;    // selects other random numbers for the independent rendering
};

// Returns as soon as a verdict is reached.
CertificationResult certify(render::Session& session, const CertifiedImage& image, const CertifyOptions& options,
                            const bench::Progress& progress);

}  // namespace etendue::advisor
