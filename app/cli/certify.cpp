// etendue certify: renders an image again independently and checks whether the error that it states is correct.
#include <cmath>
#include <cstdio>
#include <memory>

#include "advisor/certify.h"
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

void print(const advisor::CertificationResult& f, const advisor::CertifiedImage& claim) {
  if (f.verdict == advisor::Verdict::confirmed) {
    std::printf("stands: true RMSE %.3g, stated %.3g .. %.3g; relMSE %.3g, stated %.3g .. %.3g\n", f.rmse.value,
                claim.certificate.rmse->interval.low, claim.certificate.rmse->interval.high, f.relmse.value,
                claim.certificate.relmse->interval.low, claim.certificate.relmse->interval.high);
  } else if (f.verdict == advisor::Verdict::undecided) {
    std::printf("undecided: the time is too short");
    if (f.seconds_needed > 0 && std::isfinite(f.seconds_needed))
      std::printf("; give --time %.0f", std::ceil(f.seconds_needed));
    std::printf("\n");
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
  const auto finding = advisor::certify(session, *claim, a.certify, [&](double done, const std::string& task) {
    progress.show(done, task);
    return !interrupted;
  });
  progress.finish();
  if (a.json)
    std::printf("%s\n", finding_json(finding, *claim).dump(2).c_str());
  else
    print(finding, *claim);
  if (finding.interrupted) return static_cast<int>(Fault::interrupted);
  return finding.verdict == advisor::Verdict::confirmed ? 0 : 1;
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
                       .doc = "Longest rendering time in seconds",
                       .bounds = kPositive},
                      seed_option(a->certify.seed),
                      threads_option(a->threads),
                      json_flag(a->json)},
          .run = [a] { return run_certify(*a); }};
}

}  // namespace etendue::cli
