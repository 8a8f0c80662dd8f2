#include "advisor/certify.h"

#include <algorithm>
#include <cmath>

#include "advisor/reference_integrator.h"
#include "advisor/report_numbers.h"
#include "base/hash.h"
#include "render/image_output.h"
#include "scene/compiled_scene.h"
#include "scene/light_kinds.h"

namespace etendue::advisor {
namespace {

// Half-widths of intervals of the normal distribution in standard deviations: 95 %, 99.9 %, and 99.7 % coverage.
constexpr double k95 = 1.96, k999 = 3.29, kTrueErrorSigmas = 3;
// Relative precision of the true RMSE that suffices for a verdict.
constexpr double kSufficientPrecision = 0.02;

// Samples per pixel before the first comparison; doubled after each undecided one.
constexpr uint32_t kFirstSamples = 4;

// True if one declaration is a proper superset of the other. Paths from lights without extent count if the scene has
// such lights.
bool finds_more(const DeclaredPaths& one, const DeclaredPaths& other, bool point_lights) {
  const bool includes =
      without(other.paths, one.paths).empty() && (!point_lights || without(other.point_paths, one.point_paths).empty());
  return includes && !(one.paths == other.paths && (!point_lights || one.point_paths == other.point_paths));
}

// The document of the independent rendering: the reference integrator, or an unbiased one that finds more in this
// scene.
render::Document independent_document(const render::Document& document, const scene::CompiledScene& scene,
                                      const CertifyOptions& options) {
  render::Document d = with_reference_integrator(document);
  const bool point_lights = has_point_lights(*document.scene);
  for (const auto& info : integrator::integrator_infos()) {
    render::Document other = d;
    other.method.integrator = info.name;
    if (info.bias == integrator::Bias::unbiased &&
        finds_more(declared_paths(other, scene), declared_paths(d, scene), point_lights))
      d = other;
  }
  d.seed = mix_bits(mix_bits(document.seed) ^ (options.seed + 0x6365727469667921ULL)) & 0x3fffffff;
  return d;
}

// The 95 % interval extended to 99.9 %; the logarithms of both ends are scaled about that of the value.
film::Interval extended_interval(const IntervalEstimate& e) {
  const auto extended = [&](double end) {
    return e.value > 0 && end > 0 ? e.value * std::pow(end / e.value, k999 / k95) : end;
  };
  return {extended(e.interval.low), extended(e.interval.high)};
}

std::string interval_text(const film::Interval& i) {
  return std::isfinite(i.high) ? number(i.low) + " .. " + number(i.high) : number(i.low) + " or more";
}

// Compares a certified value with the one that follows from the variance layer of the image; empty if they agree. The
// certified error may be larger where paths are missing, because the layer contains noise only, but never smaller.
std::string contradiction(const char* what, double from_layer, const IntervalEstimate& certified, bool complete) {
  const bool is_less = complete && from_layer < certified.interval.low;
  if (!is_less && from_layer <= certified.interval.high) return {};
  return std::string("the variance layer of the image implies ") + what + " " + number(from_layer) +
         ", but its certificate states " + interval_text(certified.interval);
}

std::string contradiction(const CertifiedImage& image) {
  const auto variance = image.variance(), rgb = image.rgb();
  if (variance.empty()) return {};
  double sum = 0;
  for (const float v : variance) sum += double{v};
  const auto n = static_cast<double>(variance.size());
  const Certificate& c = image.certificate;
  const bool complete = c.missing.empty();
  const std::string text = contradiction("an RMSE of", std::sqrt(sum / n), *c.rmse, complete);
  if (!text.empty()) return text;
  const auto relative = film::relative_error(image.image.width, image.image.height, rgb, variance);
  return contradiction("a relMSE of", relative.relmse, *c.relmse, complete);
}

struct TestedErrors {
  Verdict verdict;
  double precision_factor = 0;  // by how much the standard error of the true RMSE must fall for a verdict
};

// Compares the certified RMSE with the true one.
TestedErrors compare(const MeanSquare& truth, const IntervalEstimate& certified) {
  const film::Interval root = extended_interval(certified), allowed{sqr(root.low), sqr(root.high)};
  const double margin = kTrueErrorSigmas * truth.standard_error;
  if (truth.value - margin > allowed.high || truth.value + margin < allowed.low) return {Verdict::refuted};
  const bool is_surely_inside = truth.value - margin >= allowed.low && truth.value + margin <= allowed.high;
  const bool is_inside = truth.value >= allowed.low && truth.value <= allowed.high;
  const double sufficient = 2 * kSufficientPrecision * std::max(0.0, truth.value);
  if (is_surely_inside || (is_inside && margin <= sufficient)) return {Verdict::confirmed};
  const double needed = std::max(sufficient, std::min(truth.value - allowed.low, allowed.high - truth.value));
  return {Verdict::undecided, needed > 0 ? margin / needed : INFINITY};
}

class Certifier {
 public:
  Certifier(render::Session& session, const CertifiedImage& image, const CertifyOptions& options,
            const bench::Progress& progress)
      : session_(session),
        image_(image),
        options_(options),
        progress_(progress),
        document_(independent_document(
            image.document, *scene::compile(image.document.scene, image.document.camera, session.scene()), options)) {
    result_.method = document_.method.integrator + ":sampler=" + document_.method.sampler;
  }

  CertificationResult run() {
    if (!image_.certificate.rmse || !image_.certificate.relmse) return without_statement();
    if (const auto text = contradiction(image_); !text.empty()) return refute(text);
    for (uint32_t samples = kFirstSamples;; samples *= 2) {
      const bool has_time = render(samples);
      if (samples == kFirstSamples && options_.on_estimate && !result_.interrupted)
        options_.on_estimate(seconds_for_samples_of_image());
      if (result_.samples < film::kHalfBuffers) return without_comparison();
      if (compare_with_truth()) return result_;
      if (has_time) continue;
      if (!result_.interrupted && !contradicted_) result_.verdict = Verdict::consistent;
      return result_;
    }
  }

 private:
  CertificationResult refute(const std::string& reason) {
    result_.verdict = Verdict::refuted;
    result_.reasons.push_back(reason);
    return result_;
  }

  CertificationResult without_statement() {
    result_.verdict = Verdict::undecided;
    result_.reasons.push_back("the certificate states no error, because " +
                              std::string(image_.samples < film::kHalfBuffers
                                              ? "the image has one sample per pixel and an estimate needs two"
                                              : "none could be estimated from the samples of the image"));
    return result_;
  }

  CertificationResult without_comparison() {
    result_.seconds_needed = seconds_for_samples_of_image();
    return result_;
  }

  // The time of an independent rendering with at least the sample count of the image, which suffices in most cases. The
  // comparison waits for the next doubling of the samples.
  double seconds_for_samples_of_image() const {
    uint32_t samples = kFirstSamples;
    while (samples < image_.samples) samples *= 2;
    return result_.seconds / std::max(1u, result_.samples) * samples;
  }

  // Continues the independent rendering to this sample count; false if the time is used up or it was interrupted.
  bool render(uint32_t samples) {
    render::Document d = document_;
    const double left = options_.seconds - result_.seconds;
    d.limits = {samples, std::max(1e-3, left), 0};
    const uint64_t version = result_.samples > 0 ? session_.submit(d, std::move(film_)) : session_.submit(d);
    const bool completed = bench::wait_for(session_, version, [&](const render::Status& s) {
      return progress_(std::min(1.0, (result_.seconds + s.seconds) / options_.seconds), "independent rendering");
    });
    const auto status = session_.status();
    film_ = session_.film_copy();
    result_.interrupted = !completed;
    result_.seconds += status.seconds;
    result_.samples = status.samples;
    return completed && status.samples == samples && result_.seconds < options_.seconds;
  }

  // Returns true if a verdict was reached.
  bool compare_with_truth() {
    const TrueError truth = true_error(image_.rgb(), film_);
    result_.rmse = {truth.absolute.root(), truth.absolute.root_interval(kTrueErrorSigmas)};
    const double margin = kTrueErrorSigmas * truth.relative.standard_error;
    result_.relmse = {truth.relative.value,
                      {std::max(0.0, truth.relative.value - margin), truth.relative.value + margin}};
    TestedErrors compared = compare(truth.absolute, *image_.certificate.rmse);
    // With few samples, a few pixels dominate the comparison, and its errors are not normally distributed. A contradiction
    // has to hold for twice the samples as well.
    const bool contradicts = compared.verdict == Verdict::refuted;
    if (contradicts && !contradicted_ && result_.samples < image_.samples) compared = {Verdict::undecided};
    contradicted_ = contradicts;
    result_.verdict = compared.verdict;
    result_.reasons.clear();
    if (compared.verdict == Verdict::refuted) {
      const film::Interval& interval = result_.rmse.interval;
      result_.reasons.push_back("true RMSE " + number(result_.rmse.value) + " +- " +
                                number(0.5 * (interval.high - interval.low) / kTrueErrorSigmas) + ", stated " +
                                interval_text(image_.certificate.rmse->interval));
    }
    find_changed_blocks();
    // The noise of the comparison is unknown before it is below that of the image. Later, the standard error of the true
    // RMSE falls at least as 1 / sqrt(time).
    result_.seconds_needed = result_.samples < image_.samples
                                 ? seconds_for_samples_of_image()
                                 : result_.seconds * sqr(std::max(1.0, compared.precision_factor));
    return compared.verdict != Verdict::undecided;
  }

  void find_changed_blocks() {
    // Missing paths and bias change blocks as a modification would.
    if (!image_.certificate.missing.empty() || image_.certificate.bias != integrator::Bias::unbiased) return;
    // Adaptive sampling guarantees each block only half of the average sample count.
    const bool uniform = image_.document.method.adaptive == render::Adaptive::off;
    const uint32_t samples = uniform ? image_.samples : (image_.samples + 1) / 2;
    const auto test = test_blocks({.rgb = image_.rgb(), .variance = image_.variance(), .samples = samples}, film_);
    result_.changed = test.changed;
    if (test.changed.empty()) return;
    const Block& worst = test.changed.front();
    result_.verdict = Verdict::refuted;
    result_.reasons.push_back(std::to_string(test.changed.size()) + " of " + std::to_string(test.blocks) +
                              " blocks of pixels differ by more than noise explains, the worst at " +
                              std::to_string(worst.x) + "," + std::to_string(worst.y) + " by " +
                              number(std::abs(worst.sigmas)) + " standard errors");
  }

  render::Session& session_;
  const CertifiedImage& image_;
  const CertifyOptions& options_;
  const bench::Progress& progress_;
  render::Document document_;
  film::Film film_;
  bool contradicted_ = false;  // by the last comparison
  CertificationResult result_;
};

}  // namespace

std::span<const float> CertifiedImage::variance() const {
  const image::Layer* layer = image.find("variance");
  return layer && layer->pixels.size() == rgb().size() ? std::span<const float>(layer->pixels)
                                                       : std::span<const float>();
}

std::string_view verdict_name(Verdict verdict) {
  constexpr std::string_view kNames[] = {"stands", "consistent", "does not stand", "cannot tell"};
  return kNames[static_cast<size_t>(verdict)];
}

Result<CertifiedImage> read_certified_image(const std::string& file) {
  auto exr = image::read_exr(file);
  if (!exr) return exr.error();
  const auto state = exr->attributes.find(render::kStateAttribute);
  const auto certificate = exr->attributes.find(render::kCertificateAttribute);
  if (state == exr->attributes.end() || certificate == exr->attributes.end())
    return input_error(file + ": contains no certificate; give an .exr written by etendue render");
  CertifiedImage certified;
  auto document = render::document_from_state(state->second, file, &certified.samples);
  if (!document) return document.error();
  auto parsed = certificate_from_json(certificate->second, file);
  if (!parsed) return parsed.error();
  certified.document = std::move(*document);
  certified.certificate = std::move(*parsed);
  certified.image = std::move(*exr);
  const auto* beauty = certified.image.find("");
  const bool same_size =
      certified.image.width == certified.document.width && certified.image.height == certified.document.height;
  if (!same_size || !beauty || beauty->channels.size() != 3)
    return input_error(file + ": the image does not match its settings, " + std::to_string(certified.document.width) +
                       "x" + std::to_string(certified.document.height) + " pixels with three channels");
  if (!std::ranges::all_of(beauty->pixels, [](float v) { return std::isfinite(v); }))
    return input_error(file + ": contains pixels that are not finite; the certificate cannot be verified");
  return certified;
}

CertificationResult certify(render::Session& session, const CertifiedImage& image, const CertifyOptions& options,
                            const bench::Progress& progress) {
  return Certifier(session, image, options, progress).run();
}

}  // namespace etendue::advisor
