// etendue certify: renders an image again independently and checks whether the error that it states is correct.
#include <cmath>
#include <cstdio>
#include <memory>

#include "advisor/certify.h"
#include "base/json_text.h"
#include "base/number_text.h"
#include "command.h"
#include "interrupt.h"
#include "json.h"
#include "progress_bar.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct CertifyArguments {
  std::string image;
  advisor::CertifyOptions certify;
  int threads = 0;
  bool json = false;
};

json interval_json(const advisor::IntervalEstimate& s) { return {s.interval.low, number_json(s.interval.high)}; }

json finding_json(const advisor::CertificationResult& f, const advisor::CertifiedImage& claim) {
  json changed = json::array();
  for (const auto& block : f.changed) changed.push_back({{"x", block.x}, {"y", block.y}, {"sigmas", block.sigmas}});
  return {{"verdict", advisor::verdict_name(f.verdict)},
          {"reasons", f.reasons},
          {"stated", json::parse(advisor::certificate_json(claim.certificate))},
          {"rmse", f.rmse.value},
          {"rmse_interval", interval_json(f.rmse)},
          {"relmse", f.relmse.value},
          {"relmse_interval", interval_json(f.relmse)},
          {"changed_blocks", changed},
          {"method", f.method},
          {"spp", f.samples},
          {"seconds", f.seconds},
          {"seconds_wanted", number_json(f.seconds_needed)}};
}

// "; give --time 12"; empty if the time is unknown.
std::string time_text(double seconds, const char* introduction) {
  if (!(seconds > 0) || !std::isfinite(seconds)) return "";
  return introduction + format_text("%.0f", std::ceil(seconds));
}

// At the start, on standard error.
void print_expected_time(double needed, double limit) {
  std::string text = "a confirmation takes about " + format_duration(needed);
  if (needed > limit) text += "; the statement after " + format_duration(limit) + " (--time) will be weaker";
  std::fprintf(stderr, "%s\n", text.c_str());
}

void print(const advisor::CertificationResult& f, const advisor::CertifiedImage& claim) {
  if (f.verdict == advisor::Verdict::confirmed) {
    std::printf("stands: true RMSE %.3g, stated %.3g .. %.3g; relMSE %.3g, stated %.3g .. %.3g\n", f.rmse.value,
                claim.certificate.rmse->interval.low, claim.certificate.rmse->interval.high, f.relmse.value,
                claim.certificate.relmse->interval.low, claim.certificate.relmse->interval.high);
  } else if (f.verdict == advisor::Verdict::consistent) {
    std::printf("consistent: true RMSE between %.3g and %.3g (99.7 %%), stated %.3g .. %.3g%s\n", f.rmse.interval.low,
                f.rmse.interval.high, claim.certificate.rmse->interval.low, claim.certificate.rmse->interval.high,
                time_text(f.seconds_needed, "; a confirmation takes --time ").c_str());
  } else if (f.verdict == advisor::Verdict::undecided) {
    for (const auto& reason : f.reasons) std::printf("undecided: %s\n", reason.c_str());
    if (f.reasons.empty())
      std::printf("undecided: there was no time for a comparison%s\n",
                  time_text(f.seconds_needed, "; give --time ").c_str());
  } else {
    for (const auto& reason : f.reasons) std::printf("does not stand: %s\n", reason.c_str());
  }
  if (f.samples > 0)
    std::printf("checked with %s, %u spp in %s\n", f.method.c_str(), f.samples, format_duration(f.seconds).c_str());
}

int run_certify(const CertifyArguments& a) {
  const auto claim = advisor::read_certified_image(a.image);
  if (!claim) return fail(claim.error());
  const std::atomic<bool>& interrupted = watch_interrupts();
  render::Session session({.threads = a.threads});
  Progress progress;
  advisor::CertifyOptions options = a.certify;
  options.on_estimate = [&](double seconds) {
    progress.finish();
    print_expected_time(seconds, options.seconds);
  };
  const auto finding = advisor::certify(session, *claim, options, [&](double done, const std::string& task) {
    progress.show(done, task);
    return !interrupted;
  });
  progress.finish();
  if (a.json)
    std::printf("%s\n", json_text(finding_json(finding, *claim), 2).c_str());
  else
    print(finding, *claim);
  if (finding.interrupted) return static_cast<int>(Fault::interrupted);
  const bool holds = finding.verdict == advisor::Verdict::confirmed || finding.verdict == advisor::Verdict::consistent;
  return holds ? 0 : 1;
}

}  // namespace

Command certify_command() {
  const auto a = std::make_shared<CertifyArguments>();
  return {.name = "certify",
          .summary = "Check the error that an image states by rendering it again independently",
          .options = {{.names = "image",
                       .target = &a->image,
                       .doc = "An .exr file that etendue render wrote",
                       .required = true},
                      {.names = "--time",
                       .target = &a->certify.seconds,
                       .doc = "Longest rendering time in seconds (10); less time gives a weaker statement",
                       .bounds = kPositive},
                      seed_option(a->certify.seed),
                      threads_option(a->threads),
                      json_flag(a->json)},
          .run = [a] { return run_certify(*a); }};
}

}  // namespace etendue::cli
