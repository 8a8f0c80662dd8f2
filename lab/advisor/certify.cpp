#include "advisor/certify.h"

#include <algorithm>
#include <cmath>

#include "advisor/light_kinds.h"
#include "advisor/number_text.h"
#include "advisor/reference_method.h"
#include "base/hash.h"
#include "render/image_output.h"
#include "scene/compiled_scene.h"

namespace etendue::advisor {
namespace {

// Of the normal distribution: 95 %, 99.9 %, and 99.7 % within.
constexpr double k95 = 1.96, k999 = 3.29, kTrue = 3;
// So well known, the true error speaks for itself.
constexpr double kPrecise = 0.02;

// Samples of every pixel for the first look.
constexpr uint32_t kFirstLook = 4;

// Whether one method finds everything that the other does, and more; lights without extent count if there are any.
bool finds_more(const Found& one, const Found& other, bool points) {
  const bool all =
      without(other.paths, one.paths).empty() && (!points || without(other.point_paths, one.point_paths).empty());
  return all && !(one.paths == other.paths && (!points || one.point_paths == other.point_paths));
}

// Who judges: the trusted method, or an unbiased one that finds more in this scene.
render::Document judge_of(const render::Document& document, const scene::CompiledScene& scene,
                          const CertifyOptions& options) {
  render::Document d = trusted(document);
  const bool points = has_point_lights(*document.scene);
  for (const auto& info : integrator::integrator_infos()) {
    render::Document other = d;
    other.method.integrator = info.name;
    if (info.bias == integrator::Bias::unbiased && finds_more(declared(other, scene), declared(d, scene), points))
      d = other;
  }
  d.seed = mix_bits(mix_bits(document.seed) ^ (options.seed + 0x6365727469667921ULL)) & 0x3fffffff;
  return d;
}

// The interval of 95 % made one of 99.9 %, both ends in proportion to the logarithm.
film::Interval generous(const Stated& stated) {
  const auto stretched = [&](double end) {
    return stated.value > 0 && end > 0 ? stated.value * std::pow(end / stated.value, k999 / k95) : end;
  };
  return {stretched(stated.interval.low), stretched(stated.interval.high)};
}

std::string interval_text(const film::Interval& i) {
  return std::isfinite(i.high) ? number(i.low) + " .. " + number(i.high) : number(i.low) + " or more";
}

// What the picture's own layer of variance gives for a stated number; empty if they agree. Where something is missing
// the layer says less than the statement; it never says more.
std::string contradiction(const char* what, double by_layer, const Stated& stated, bool complete) {
  const bool less = complete && by_layer < stated.interval.low;
  if (!less && by_layer <= stated.interval.high) return {};
  return std::string("it contradicts itself: its layer of variance gives ") + what + " " + number(by_layer) +
         ", it states " + interval_text(stated.interval);
}

std::string contradiction(const Claim& claim) {
  const auto variance = claim.variance(), rgb = claim.rgb();
  if (variance.empty()) return {};
  double squares = 0;
  for (const float v : variance) squares += double{v};
  const auto n = static_cast<double>(variance.size());
  const Certificate& c = claim.certificate;
  const bool complete = c.missing.empty();
  const std::string said = contradiction("an RMSE of", std::sqrt(squares / n), *c.rmse, complete);
  if (!said.empty()) return said;
  const auto relative = film::relative_error(claim.picture.width, claim.picture.height, rgb, variance);
  return contradiction("a relMSE of", relative.relmse, *c.relmse, complete);
}

struct Comparison {
  Verdict verdict;
  double spare = 0;  // so many times more exactly the truth would have to be known
};

// The stated RMSE against the truth.
Comparison compare(const MeanSquare& truth, const Stated& stated) {
  const film::Interval root = generous(stated), allowed{sqr(root.low), sqr(root.high)};
  const double margin = kTrue * truth.standard_error;
  if (truth.value - margin > allowed.high || truth.value + margin < allowed.low) return {Verdict::falls};
  const bool surely = truth.value - margin >= allowed.low && truth.value + margin <= allowed.high;
  const bool inside = truth.value >= allowed.low && truth.value <= allowed.high;
  const double precise = 2 * kPrecise * std::max(0.0, truth.value);
  if (surely || (inside && margin <= precise)) return {Verdict::stands};
  const double room = std::max(precise, std::min(truth.value - allowed.low, allowed.high - truth.value));
  return {Verdict::cannot_tell, room > 0 ? margin / room : INFINITY};
}

class Judge {
 public:
  Judge(render::Session& session, const Claim& claim, const CertifyOptions& options, const bench::Progress& watch)
      : session_(session),
        claim_(claim),
        options_(options),
        watch_(watch),
        document_(judge_of(claim.document,
                           *scene::compile(claim.document.scene, claim.document.camera, session.scene()), options)) {
    finding_.method = document_.method.integrator + ":sampler=" + document_.method.sampler;
  }

  Finding judge() {
    if (!claim_.certificate.rmse || !claim_.certificate.relmse) return reject("it states no error");
    if (const auto said = contradiction(claim_); !said.empty()) return reject(said);
    for (uint32_t samples = kFirstLook;; samples *= 2) {
      const bool go_on = render(samples);
      if (finding_.samples < film::kHalfBuffers) return without_a_look();
      if (look() || !go_on) return finding_;
    }
  }

 private:
  Finding reject(const std::string& reason) {
    finding_.verdict = Verdict::falls;
    finding_.reasons.push_back(reason);
    return finding_;
  }

  // As many samples as the picture has would mostly do.
  Finding without_a_look() {
    const double each = finding_.seconds / std::max(1u, finding_.samples);
    finding_.seconds_wanted = each * std::max(kFirstLook, claim_.samples);
    return finding_;
  }

  // Goes on to so many samples; false if there is no more time.
  bool render(uint32_t samples) {
    render::Document d = document_;
    const double left = options_.seconds - finding_.seconds;
    d.limits = {samples, std::max(1e-3, left), 0};
    const uint64_t version = finding_.samples > 0 ? session_.submit(d, std::move(film_)) : session_.submit(d);
    const bool whole = bench::wait_for(session_, version, [&](const render::Status& s) {
      return watch_(std::min(1.0, (finding_.seconds + s.seconds) / options_.seconds), "replicates");
    });
    const auto status = session_.status();
    film_ = session_.film_copy();
    // Both halves must hold as many samples.
    finding_.interrupted = !whole;
    finding_.seconds += status.seconds;
    finding_.samples = status.samples;
    return whole && status.samples == samples && finding_.seconds < options_.seconds;
  }

  // Whether the picture's error could be told.
  bool look() {
    const TrueError truth = true_error(claim_.rgb(), film_);
    finding_.rmse = {truth.absolute.root(), truth.absolute.root_interval(kTrue)};
    const double margin = kTrue * truth.relative.standard_error;
    finding_.relmse = {truth.relative.value,
                       {std::max(0.0, truth.relative.value - margin), truth.relative.value + margin}};
    const auto compared = compare(truth.absolute, *claim_.certificate.rmse);
    finding_.verdict = compared.verdict;
    finding_.reasons.clear();
    if (compared.verdict == Verdict::falls)
      finding_.reasons.push_back("true RMSE " + number(finding_.rmse.value) + " +- " +
                                 number(0.5 * (finding_.rmse.interval.high - finding_.rmse.interval.low) / kTrue) +
                                 ", stated " + interval_text(claim_.certificate.rmse->interval));
    look_for_changes();
    // Errors of the truth fall as the root of the time at worst.
    finding_.seconds_wanted = finding_.seconds * sqr(std::max(1.0, compared.spare));
    return compared.verdict != Verdict::cannot_tell;
  }

  void look_for_changes() {
    // Where something is missing, blocks are off without anyone having changed them.
    if (!claim_.certificate.missing.empty() || claim_.certificate.bias != integrator::Bias::unbiased) return;
    // Adaptive sampling gives a block half of its even share at the least.
    const bool even = claim_.document.method.adaptive == render::Adaptive::off;
    const uint32_t samples = even ? claim_.samples : (claim_.samples + 1) / 2;
    const auto blocks = changed_blocks({claim_.rgb(), claim_.variance(), samples}, film_);
    finding_.changed = blocks.changed;
    if (blocks.changed.empty()) return;
    const Block& worst = blocks.changed.front();
    finding_.verdict = Verdict::falls;
    finding_.reasons.push_back(std::to_string(blocks.changed.size()) + " of " + std::to_string(blocks.blocks) +
                               " blocks of pixels are off by more than chance allows, the worst at " +
                               std::to_string(worst.x) + "," + std::to_string(worst.y) + " by " +
                               number(std::abs(worst.sigmas)) + " standard errors");
  }

  render::Session& session_;
  const Claim& claim_;
  const CertifyOptions& options_;
  const bench::Progress& watch_;
  render::Document document_;
  film::Film film_;
  Finding finding_;
};

}  // namespace

std::span<const float> Claim::variance() const {
  const image::Layer* layer = picture.find("variance");
  return layer && layer->pixels.size() == rgb().size() ? std::span<const float>(layer->pixels)
                                                       : std::span<const float>();
}

std::string_view verdict_name(Verdict verdict) {
  return verdict == Verdict::stands ? "stands" : verdict == Verdict::falls ? "does not stand" : "cannot tell";
}

Result<Claim> read_claim(const std::string& file) {
  auto picture = image::read_exr(file);
  if (!picture) return picture.error();
  const auto state = picture->attributes.find(render::kStateAttribute),
             certificate = picture->attributes.find(render::kCertificateAttribute);
  if (state == picture->attributes.end() || certificate == picture->attributes.end())
    return input_error(file + ": states nothing of its error; give an .exr that etendue render wrote");
  Claim claim;
  auto document = render::document_from_state(state->second, file, &claim.samples);
  if (!document) return document.error();
  auto read = certificate_from_json(certificate->second, file);
  if (!read) return read.error();
  claim.document = std::move(*document), claim.certificate = std::move(*read), claim.picture = std::move(*picture);
  const auto* beauty = claim.picture.find("");
  if (claim.picture.width != claim.document.width || claim.picture.height != claim.document.height || !beauty ||
      beauty->channels.size() != 3)
    return input_error(file + ": is not the picture that its settings make, " + std::to_string(claim.document.width) +
                       "x" + std::to_string(claim.document.height) + " pixels of three channels");
  if (!std::ranges::all_of(beauty->pixels, [](float v) { return std::isfinite(v); }))
    return input_error(file + ": has pixels that are not finite; no statement of its error can stand");
  return claim;
}

Finding certify(render::Session& session, const Claim& claim, const CertifyOptions& options,
                const bench::Progress& watch) {
  return Judge(session, claim, options, watch).judge();
}

}  // namespace etendue::advisor
