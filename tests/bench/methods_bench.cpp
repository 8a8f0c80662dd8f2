// How fast methods are beside each other: rays and samples per second of each in turns, as ratios to the first.
//
//   methods_bench [SCENE [WIDTHxHEIGHT [METHOD...]]]      methods as `etendue bench` takes them; the first is compared
//   to
//
// All go on in turns of a quarter of a second on one thread, so that whatever else the machine does falls on all alike.
#include <algorithm>
#include <cstdio>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "bench/lane.h"
#include "bench/method.h"

namespace etendue {
namespace {

constexpr int kTurns = 8;
constexpr double kSeconds = 0.25;

struct Contender {
  Contender(const bench::Method& method, const std::shared_ptr<const scene::CompiledScene>& scene)
      : name(method.name), lane(method.document, scene) {}

  std::string name;
  bench::Lane lane;
  std::vector<double> rays, samples;  // per second, by turn
  double seconds = 0;
};

double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  std::sort(ratios.begin(), ratios.end());
  return ratios[ratios.size() / 2];
}

void take_turn(render::Workers& workers, Contender& c) {
  const double before = c.lane.seconds(), rays = c.lane.rays_per_second() * c.seconds;
  const uint32_t samples = c.lane.samples();
  c.lane.run(workers, UINT32_MAX, kSeconds, [] { return true; });
  const double took = c.lane.seconds() - before;
  c.seconds += took;
  c.rays.push_back((c.lane.rays_per_second() * c.seconds - rays) / took);
  c.samples.push_back((c.lane.samples() - samples) / took);
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
  render::Workers workers(1);
  for (int turn = 0; turn < kTurns; ++turn)
    for (Contender& c : contenders) take_turn(workers, c);
  const Contender& first = contenders.front();
  std::printf("%s, %d x %d\n%-40s %12s %10s %12s %10s\n", scene.c_str(), width, height, "method", "Mrays/s", "ratio",
              "samples/s", "ratio");
  for (const Contender& c : contenders)
    std::printf("%-40s %12.3f %10.3f %12.2f %10.3f\n", c.name.c_str(), c.lane.rays_per_second() * 1e-6,
                median_ratio(c.rays, first.rays), c.lane.samples() / c.seconds, median_ratio(c.samples, first.samples));
  return 0;
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  int width = 256, height = 256;
  if (words.size() > 1 && std::sscanf(words[1].c_str(), "%dx%d", &width, &height) != 2)
    return std::fprintf(stderr, "methods_bench: %s is no size; give one like 256x256\n", words[1].c_str()), 2;
  std::vector<std::string> methods{"path", "bdpt", "pssmlt:form=path", "pssmlt:form=bidirectional",
                                   "pssmlt:form=multiplexed"};
  if (words.size() > 2) methods.assign(words.begin() + 2, words.end());
  return etendue::run(words.empty() ? "cornell" : words[0], width, height, methods);
}
