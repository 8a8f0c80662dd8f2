// Whether a picture's certificate stands: independent renderings against what it states.
//
// The picture is made anew with other random numbers by an unbiased method that finds all that any does, and the
// picture's true error is told from both (true_error.h). The statement falls if that error lies outside of what 999 of
// 1000 honest statements allow, if its parts contradict each other, or if blocks of pixels were changed (tampering.h).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "advisor/block_test.h"
#include "advisor/certificate.h"
#include "advisor/true_error.h"
#include "image/image.h"

namespace etendue::advisor {

// A picture with what it says of itself.
struct Claim {
  render::Document document;  // its settings
  uint32_t samples = 0;
  image::LayeredImage picture;
  Certificate certificate;

  std::span<const float> rgb() const { return picture.find("")->pixels; }
  std::span<const float> variance() const;  // of each number; empty if it is not known
};

// An .exr that this program wrote. Anything else is an input error, and so is one whose size is not that of its
// settings, or that has pixels which are not finite.
Result<Claim> read_claim(const std::string& file);

enum class Verdict { stands, falls, cannot_tell };
std::string_view verdict_name(Verdict verdict);

struct Finding {
  Verdict verdict = Verdict::cannot_tell;
  std::vector<std::string> reasons;  // sentences
  std::string method;                // that judged
  uint32_t samples = 0;
  double seconds = 0;  // of rendering
  // The picture's true error, RMSE and relMSE, with an interval of three standard errors.
  Stated rmse, relmse;
  std::vector<Block> changed;
  double seconds_wanted = 0;  // where it cannot be told: what would do, about
  bool interrupted = false;
};

struct CertifyOptions {
  double seconds = 10;  // of rendering at most
  uint64_t seed = 0;    // another one judges by other random numbers
};

// Ends as soon as it can tell.
Finding certify(render::Session& session, const Claim& claim, const CertifyOptions& options,
                const bench::Progress& watch);

}  // namespace etendue::advisor
