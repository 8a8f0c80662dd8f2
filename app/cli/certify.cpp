// etendue certify: whether the error that a picture states stands.
#include "advisor/certify.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "interrupt.h"
#include "progress.h"

namespace etendue::cli {
namespace {

struct Options {
  std::string image;
  advisor::CertifyOptions certify;
  int threads = 0;
  bool json = false;
};

nlohmann::json interval_json(const advisor::IntervalEstimate& s) {
  return {s.interval.low, std::isfinite(s.interval.high) ? nlohmann::json(s.interval.high) : nlohmann::json()};
}

nlohmann::json finding_json(const advisor::CertificationResult& f, const advisor::CertifiedImage& claim) {
  nlohmann::json changed = nlohmann::json::array();
  for (const auto& block : f.changed) changed.push_back({{"x", block.x}, {"y", block.y}, {"sigmas", block.sigmas}});
  return {{"verdict", advisor::verdict_name(f.verdict)},
          {"reasons", f.reasons},
          {"stated", nlohmann::json::parse(advisor::certificate_json(claim.certificate))},
          {"rmse", f.rmse.value},
          {"rmse_interval", interval_json(f.rmse)},
          {"relmse", f.relmse.value},
          {"relmse_interval", interval_json(f.relmse)},
          {"changed_blocks", changed},
          {"method", f.method},
          {"spp", f.samples},
          {"seconds", f.seconds},
          {"seconds_wanted", std::isfinite(f.seconds_needed) ? nlohmann::json(f.seconds_needed) : nlohmann::json()}};
}

void print(const advisor::CertificationResult& f, const advisor::CertifiedImage& claim) {
  if (f.verdict == advisor::Verdict::confirmed) {
    std::printf("stands: true RMSE %.3g, stated %.3g .. %.3g; relMSE %.3g, stated %.3g .. %.3g\n", f.rmse.value,
                claim.certificate.rmse->interval.low, claim.certificate.rmse->interval.high, f.relmse.value,
                claim.certificate.relmse->interval.low, claim.certificate.relmse->interval.high);
  } else if (f.verdict == advisor::Verdict::undecided) {
    std::printf("cannot tell in this time");
    if (f.seconds_needed > 0 && std::isfinite(f.seconds_needed))
      std::printf(": needs about %.0f s", std::ceil(f.seconds_needed));
    std::printf("\n");
  } else {
    for (const auto& reason : f.reasons) std::printf("does not stand: %s\n", reason.c_str());
  }
  if (f.samples > 0) std::printf("judged by %s, %u spp in %.1f s\n", f.method.c_str(), f.samples, f.seconds);
}

int run(const Options& o) {
  const auto claim = advisor::read_certified_image(o.image);
  if (!claim) return fail(claim.error());
  const std::atomic<bool>& interrupted = watch_interrupts();
  render::SessionOptions session_options;
  session_options.threads = o.threads;
  render::Session session(session_options);
  Progress bar;
  const auto finding = advisor::certify(session, *claim, o.certify, [&](double done, const std::string& what) {
    bar.show(done, what);
    return !interrupted;
  });
  bar.finish();
  if (o.json)
    std::printf("%s\n", finding_json(finding, *claim).dump(2).c_str());
  else
    print(finding, *claim);
  if (finding.interrupted) return static_cast<int>(Fault::interrupted);
  return finding.verdict == advisor::Verdict::confirmed ? 0 : 1;
}

}  // namespace

Command add_certify(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("image", o->image, "An .exr that etendue render wrote")->required();
  app.add_option("--time", o->certify.seconds, "Seconds of rendering at most")->check(CLI::PositiveNumber);
  app.add_option("--seed", o->certify.seed, "Judge by other random numbers")->check(CLI::NonNegativeNumber);
  app.add_option("--threads", o->threads, "0: one per hardware thread")->check(CLI::Range(0, 1024));
  app.add_flag("--json", o->json, "Print JSON");
  return [o] { return run(*o); };
}

}  // namespace etendue::cli
