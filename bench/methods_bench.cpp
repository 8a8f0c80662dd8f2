// Relative speed of integrators: rays and samples per second, as ratios to the first integrator.
//
//   methods_bench [SCENE [WIDTHxHEIGHT [METHOD...]]]      METHOD as in `etendue bench`
//
// "bookkeeping" is the share of the time that is spent on neither rays nor shading (random numbers and acceptance
// decisions of Markov chains, sorting photons and looking them up). The next column is the ratio of rays per second
// without it. Integrators with several phases are also shown phase by phase.
//
// All integrators run alternately in rounds of half a second on one thread, so that other load of the machine affects
// all of them alike.
#include <cstdio>
#include <deque>

#include "integrator_harness.h"
#include "bench/method_spec.h"
#include "bench/timed_render.h"

namespace etendue {
namespace {

constexpr int kTurns = 8;
constexpr double kSeconds = 0.25;  // with a film, and the same time without

struct Contender {
  Contender(const bench::MethodSpec& method, const std::shared_ptr<const scene::CompiledScene>& scene)
      : name(method.name), timed_render(method.document, scene), harness(method.document, scene) {}

  std::string name;
  bench::TimedRender timed_render;
  IntegratorHarness harness;
  std::vector<double> rays, samples;  // per second, by round
  double seconds = 0;

  double bookkeeping_share() const { return harness.total().bookkeeping / harness.total().seconds; }
};

double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  std::sort(ratios.begin(), ratios.end());
  return ratios[ratios.size() / 2];
}

void take_turn(render::ThreadPool& workers, Contender& c) {
  const double before = c.timed_render.seconds(), rays = c.timed_render.rays_per_second() * c.seconds;
  const uint32_t samples = c.timed_render.samples();
  c.timed_render.run(workers, UINT32_MAX, kSeconds, [] { return true; });
  const double took = c.timed_render.seconds() - before;
  c.seconds += took;
  c.rays.push_back((c.timed_render.rays_per_second() * c.seconds - rays) / took);
  c.samples.push_back((c.timed_render.samples() - samples) / took);
  const double end = c.harness.total().seconds + kSeconds;
  do c.harness.step();
  while (c.harness.total().seconds < end);
}

double rays_per_second(const IntegratorHarness::Part& part) { return static_cast<double>(part.rays) / part.seconds; }

void print(const Contender& c, const Contender& first) {
  const double ratio = median_ratio(c.rays, first.rays);
  const double without = ratio * (1 - first.bookkeeping_share()) / (1 - c.bookkeeping_share());
  std::printf("%-34s %8.3f %7.3f %8.1f %9.3f %11.2f %7.3f\n", c.name.c_str(), c.timed_render.rays_per_second() * 1e-6,
              ratio, 100 * c.bookkeeping_share(), without, c.timed_render.samples() / c.seconds,
              median_ratio(c.samples, first.samples));
  const auto& parts = c.harness.parts();
  for (size_t i = 0; i < parts.size() && parts.size() > 1; ++i) {
    const IntegratorHarness::Part& p = parts[i];
    const double of_part = rays_per_second(p) / rays_per_second(first.harness.total());
    std::printf("  %-32s %8.3f %7.3f %8.1f %9.3f %10.1f%% of the time\n", p.name.c_str(), rays_per_second(p) * 1e-6,
                of_part, 100 * p.bookkeeping / p.seconds,
                p.bookkeeping < p.seconds ? of_part / (1 - p.bookkeeping / p.seconds) : 0.0,
                100 * p.seconds / c.harness.total().seconds);
  }
}

int run(const std::string& scene, int width, int height, const std::vector<std::string>& methods) {
  auto document = render::new_document(scene);
  if (!document) return std::fprintf(stderr, "%s\n", document.error().message.c_str()), 2;
  document->width = width;
  document->height = height;
  const auto compiled = scene::compile(document->scene, document->camera, nullptr);
  std::deque<Contender> contenders;
  for (const std::string& name : methods) {
    const auto method = bench::parse_method(name, *document);
    if (!method) return std::fprintf(stderr, "%s\n", method.error().message.c_str()), 2;
    contenders.emplace_back(*method, compiled);
  }
  render::ThreadPool workers(1);
  for (int turn = 0; turn < kTurns; ++turn)
    for (Contender& c : contenders) take_turn(workers, c);
  std::printf("%s, %d x %d\n%-34s %8s %7s %8s %9s %11s %7s\n", scene.c_str(), width, height, "integrator", "Mrays/s",
              "ratio", "book., %", "ratio w/o", "samples/s", "ratio");
  for (const Contender& c : contenders) print(c, contenders.front());
  return 0;
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  int width = 256, height = 256;
  if (words.size() > 1 && std::sscanf(words[1].c_str(), "%dx%d", &width, &height) != 2)
    return std::fprintf(stderr, "methods_bench: %s is not a size; expected WIDTHxHEIGHT, for example 256x256\n",
                        words[1].c_str()),
           2;
  std::vector<std::string> methods{
      "path", "light",    "bdpt", "pssmlt:form=path", "pssmlt:form=bidirectional", "pssmlt:form=multiplexed",
      "sppm", "photonmap"};
  if (words.size() > 2) methods.assign(words.begin() + 2, words.end());
  etendue::prepare_thread_for_rays();
  return etendue::run(words.empty() ? "cornell" : words[0], width, height, methods);
}
