// How fast methods are beside each other: rays and samples per second of each in turns, as ratios to the first.
//
//   methods_bench [SCENE [WIDTHxHEIGHT [METHOD...]]]      methods as `etendue bench` takes them
//
// "apart" is the share of the time that goes to neither rays nor shading (the numbers and decisions of Markov chains,
// ordering photons and looking them up), followed by the ratio of rays per second without it. Methods that work in
// phases are shown phase by phase, too.
//
// All go on in turns of half a second on one thread, so that whatever else the machine does falls on all alike.
#include <cstdio>
#include <deque>

#include "bench/method_spec.h"
#include "bench/timed_render.h"
#include "bench/work_rig.h"

namespace etendue {
namespace {

constexpr int kTurns = 8;
constexpr double kSeconds = 0.25;  // with a film, and as long without

struct Contender {
  Contender(const bench::MethodSpec& method, const std::shared_ptr<const scene::CompiledScene>& scene)
      : name(method.name), lane(method.document, scene), rig(method.document, scene) {}

  std::string name;
  bench::TimedRender lane;
  WorkRig rig;
  std::vector<double> rays, samples;  // per second, by turn
  double seconds = 0;

  double share_apart() const { return rig.total().apart / rig.total().seconds; }
};

double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  std::sort(ratios.begin(), ratios.end());
  return ratios[ratios.size() / 2];
}

void take_turn(render::ThreadPool& workers, Contender& c) {
  const double before = c.lane.seconds(), rays = c.lane.rays_per_second() * c.seconds;
  const uint32_t samples = c.lane.samples();
  c.lane.run(workers, UINT32_MAX, kSeconds, [] { return true; });
  const double took = c.lane.seconds() - before;
  c.seconds += took;
  c.rays.push_back((c.lane.rays_per_second() * c.seconds - rays) / took);
  c.samples.push_back((c.lane.samples() - samples) / took);
  const double end = c.rig.total().seconds + kSeconds;
  do c.rig.step();
  while (c.rig.total().seconds < end);
}

double rays_per_second(const WorkRig::Part& part) { return static_cast<double>(part.rays) / part.seconds; }

void print(const Contender& c, const Contender& first) {
  const double ratio = median_ratio(c.rays, first.rays);
  const double without = ratio * (1 - first.share_apart()) / (1 - c.share_apart());
  std::printf("%-34s %8.3f %7.3f %8.1f %9.3f %11.2f %7.3f\n", c.name.c_str(), c.lane.rays_per_second() * 1e-6, ratio,
              100 * c.share_apart(), without, c.lane.samples() / c.seconds, median_ratio(c.samples, first.samples));
  const auto& parts = c.rig.parts();
  for (size_t i = 0; i < parts.size() && parts.size() > 1; ++i) {
    const WorkRig::Part& p = parts[i];
    const double of_part = rays_per_second(p) / rays_per_second(first.rig.total());
    std::printf("  %-32s %8.3f %7.3f %8.1f %9.3f %10.1f%% of the time\n", p.name.c_str(), rays_per_second(p) * 1e-6,
                of_part, 100 * p.apart / p.seconds, p.apart < p.seconds ? of_part / (1 - p.apart / p.seconds) : 0.0,
                100 * p.seconds / c.rig.total().seconds);
  }
}

int run(const std::string& scene, int width, int height, const std::vector<std::string>& methods) {
  auto document = render::new_document(scene);
  if (!document) return std::fprintf(stderr, "%s\n", document.error().message.c_str()), 2;
  document->width = width, document->height = height;
  const auto compiled = scene::compile(document->scene, document->camera, nullptr);
  std::deque<Contender> contenders;
  for (const std::string& name : methods) {
    const auto method = bench::parse_method(name, *document);
    if (!method) return std::fprintf(stderr, "%s\n", method.error().message.c_str()), 2;
    contenders.emplace_back(*method, compiled);
  }
  render::ThreadPool workers(1);
  for (int task_context = 0; task_context < kTurns; ++task_context)
    for (Contender& c : contenders) take_turn(workers, c);
  std::printf("%s, %d x %d\n%-34s %8s %7s %8s %9s %11s %7s\n", scene.c_str(), width, height, "method", "Mrays/s",
              "ratio", "apart, %", "ratio w/o", "samples/s", "ratio");
  for (const Contender& c : contenders) print(c, contenders.front());
  return 0;
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  int width = 256, height = 256;
  if (words.size() > 1 && std::sscanf(words[1].c_str(), "%dx%d", &width, &height) != 2)
    return std::fprintf(stderr, "methods_bench: %s is no size; give one like 256x256\n", words[1].c_str()), 2;
  std::vector<std::string> methods{
      "path", "light",    "bdpt", "pssmlt:form=path", "pssmlt:form=bidirectional", "pssmlt:form=multiplexed",
      "sppm", "photonmap"};
  if (words.size() > 2) methods.assign(words.begin() + 2, words.end());
  etendue::prepare_thread_for_rays();
  return etendue::run(words.empty() ? "cornell" : words[0], width, height, methods);
}
