// Efficiency and cost of the light tree.
//
//   many_lights_bench [quick]
//
// First table: efficiency 1 / (MSE x time) of the tree relative to selection by power, in a hall with many lights
// (core/scene/builtin/many_lights.h), for direct light and for full paths. Both are rendered alternately on one thread;
// values are medians over the rounds. Second table: cost of a light selection and of a sample of the image, by number
// of lights, relative to one light. Third table: variance and time of sampling directions towards an area light
// relative to sampling its points, at points below the light.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <random>

#include "bench/method_spec.h"
#include "bench/timed_render.h"
#include "light/placed_light.h"
#include "metrics/convergence.h"
#include "scene/builtin/many_lights.h"

namespace etendue {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSize = 96;
constexpr uint32_t kSamples = 16;

render::Document hall(int light_count) {
  render::Document d = *render::new_document("many-lights");
  d.scene = std::make_shared<const scene::Scene>(scene::hall_of_lights(light_count));
  d.width = d.height = kSize;
  return d;
}

render::Document with_method(const render::Document& d, const std::string& method, uint64_t seed) {
  render::Document named = bench::parse_method(method, d)->document;
  named.seed = seed;
  return named;
}

double squared_error(const film::Film& film, const film::Film& reference) {
  double sum = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Rgb d = film.mean(x, y) - reference.mean(x, y);
      sum += static_cast<double>(d.r * d.r + d.g * d.g + d.b * d.b) / 3;
    }
  return sum / (kSize * kSize);
}

struct Measurement {
  double error, seconds;
};

class Hall {
 public:
  explicit Hall(int light_count) : document_(hall(light_count)) {
    compiled_ = scene::compile(document_.scene, document_.camera, nullptr);
  }

  Measurement turn(const std::string& method, uint64_t seed, uint32_t samples, const film::Film* reference) {
    bench::TimedRender timed(with_method(document_, method, seed), compiled_);
    timed.run(workers_, samples, 1e9, [] { return true; });
    return {reference ? squared_error(timed.film(), *reference) : 0, timed.seconds()};
  }

  film::Film reference(const std::string& method, uint32_t samples) {
    bench::TimedRender timed(with_method(document_, method, 7), compiled_);
    timed.run(workers_, samples, 1e9, [] { return true; });
    return timed.film();
  }

  const scene::CompiledScene& compiled() const { return *compiled_; }

 private:
  render::Document document_;
  std::shared_ptr<const scene::CompiledScene> compiled_;
  render::ThreadPool workers_{1};
};

void compare(int light_count, const std::string& method, int turns, uint32_t reference_samples) {
  Hall hall(light_count);
  const film::Film reference = hall.reference(method + ":lights=tree", reference_samples);
  std::vector<double> error, time, efficiency;
  for (int i = 0; i < turns; ++i) {
    const auto seed = static_cast<uint64_t>(100 + i);
    const Measurement power = hall.turn(method + ":lights=one", seed, kSamples, &reference);
    const Measurement tree = hall.turn(method + ":lights=tree", seed, kSamples, &reference);
    error.push_back(power.error / tree.error);
    time.push_back(tree.seconds / power.seconds);
    efficiency.push_back(error.back() / time.back());
  }
  using metrics::quantile;
  std::printf("%7d  %-20s %9.2f %9.3f %11.2f  (%.2f to %.2f)\n", light_count, method.c_str(), quantile(error, 0.5),
              quantile(time, 0.5), quantile(efficiency, 0.5), quantile(efficiency, 0.1), quantile(efficiency, 0.9));
  std::fflush(stdout);
}

// Light selections from random points in the hall.
class Choices {
 public:
  Choices() {
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (size_t i = 0; i < kCount; ++i) {
      from_.set(
          i, Vec3(scene::many::kSide, 1, scene::many::kSide) * Vec3(uniform(engine), uniform(engine), uniform(engine)));
      choice_[i] = uniform(engine) * kOneMinusEpsilon;
      u0_[i] = uniform(engine);
      u1_[i] = uniform(engine);
    }
  }

  // Nanoseconds per selection.
  double cost(const LightTable& lights, LightStrategy strategy) {
    constexpr int kRepeats = 16;
    const auto start = Clock::now();
    for (int i = 0; i < kRepeats; ++i)
      lights.sample({from_, choice_.data(), u0_.data(), u1_.data(), kCount}, samples_.data(), strategy);
    return 1e9 * std::chrono::duration<double>(Clock::now() - start).count() / (kRepeats * kCount);
  }

 private:
  static constexpr size_t kCount = 4096;
  Vec3Lanes<kCount> from_;
  alignas(64) std::array<float, kCount> choice_{}, u0_{}, u1_{};
  std::vector<LightSample> samples_{kCount};
};

// An area light of 2 x 2 m above a point at distance `height`: the irradiance there, by sampling points or directions.
class PointBelowLight {
 public:
  explicit PointBelowLight(float height) {
    for (size_t i = 0; i < kCount; ++i) from_.set(i, Vec3(0.3f, -height, 0.2f));
    std::vector<AreaLightTriangle> triangles(2);
    triangles[0].set_triangle({{-1, 0, -1}, {1, 0, -1}, {-1, 0, 1}, 1});
    triangles[1].set_triangle({{1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, 1});
    for (AreaLightTriangle& t : triangles) {
      t.radiance = Rgb(1);
      t.double_sided = false;
    }
    Bounds bounds;
    bounds.extend(Vec3(-1, -height, -1));
    bounds.extend(Vec3(1, 0, 1));
    table_ = LightTable(std::move(triangles), {}, Environment{}, bounds);
  }

  // Variance and time of an estimate from one sample.
  Measurement turn(LightStrategy strategy, uint32_t seed) {
    constexpr int kRepeats = 64;
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> uniform(0, kOneMinusEpsilon);
    double sum = 0, squares = 0, seconds = 0;
    for (int k = 0; k < kRepeats; ++k) {
      for (size_t i = 0; i < kCount; ++i) {
        choice_[i] = uniform(engine);
        u0_[i] = uniform(engine);
        u1_[i] = uniform(engine);
      }
      const auto start = Clock::now();
      table_.sample({from_, choice_.data(), u0_.data(), u1_.data(), kCount}, samples_.data(), strategy);
      seconds += std::chrono::duration<double>(Clock::now() - start).count();
      for (const LightSample& s : samples_) {
        const auto value = static_cast<double>(s.pdf > 0 ? s.wi.y / s.pdf : 0);
        sum += value;
        squares += value * value;
      }
    }
    constexpr double n = kRepeats * static_cast<double>(kCount);
    return {squares / n - sqr(sum / n), seconds / n};
  }

 private:
  static constexpr size_t kCount = 1024;
  Vec3Lanes<kCount> from_;
  alignas(64) std::array<float, kCount> choice_{}, u0_{}, u1_{};
  std::vector<LightSample> samples_{kCount};
  LightTable table_;
};

void compare_direction_sampling(int turns) {
  std::printf("\n%7s %16s %16s %10s\n", "height", "variance, points", "directions", "time");
  for (const float height : {0.05f, 0.1f, 0.25f, 0.5f, 1.0f, 1.3f, 2.0f}) {
    const auto point = std::make_unique<PointBelowLight>(height);
    std::vector<double> points, directions, time;
    for (int i = 0; i < turns; ++i) {
      const Measurement a = point->turn(LightStrategy::emission_pdf, 2), b = point->turn(LightStrategy::one, 3);
      points.push_back(a.error);
      directions.push_back(b.error);
      time.push_back(b.seconds / a.seconds);
    }
    using metrics::quantile;
    std::printf("%7.2f %16.5f %16.5f %10.2f\n", static_cast<double>(height), quantile(points, 0.5),
                quantile(directions, 0.5), quantile(time, 0.5));
  }
}

void costs(int turns) {
  std::vector<std::unique_ptr<Hall>> halls;
  const std::vector<int> counts{1, 10, 100, 1000, 10'000, 100'000};
  for (const int light_count : counts) halls.push_back(std::make_unique<Hall>(light_count));
  const auto choices = std::make_unique<Choices>();
  struct Row {
    std::vector<double> power, tree, image_power, image_tree;
  };
  std::vector<Row> rows(counts.size());
  for (int i = 0; i < turns; ++i)
    for (size_t k = 0; k < counts.size(); ++k) {
      const LightTable& lights = halls[k]->compiled().lights();
      rows[k].power.push_back(choices->cost(lights, LightStrategy::one));
      rows[k].tree.push_back(choices->cost(lights, LightStrategy::tree));
      const auto seconds = [&](const char* method) { return halls[k]->turn(method, 1, 8, nullptr).seconds; };
      rows[k].image_power.push_back(seconds("appel:lights=one"));
      rows[k].image_tree.push_back(seconds("appel:lights=tree"));
    }
  const auto median = [](const std::vector<double>& v) { return metrics::quantile(v, 0.5); };
  std::printf("\n%7s %18s %18s %16s %22s %22s\n", "lights", "by power, ns", "by the tree, ns", "tree over one",
              "image, tree over one", "tree over power");
  for (size_t k = 0; k < counts.size(); ++k)
    std::printf("%7d %18.1f %18.1f %16.2f %22.2f %22.2f\n", counts[k], median(rows[k].power), median(rows[k].tree),
                median(rows[k].tree) / median(rows[0].tree), median(rows[k].image_tree) / median(rows[0].image_tree),
                median(rows[k].image_tree) / median(rows[k].image_power));
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  using namespace etendue;
  const bool quick = argc > 1 && std::strcmp(argv[1], "quick") == 0;
  const int turns = quick ? 3 : 7;
  const uint32_t reference = quick ? 512 : 4096;
  prepare_thread_for_rays();
  std::printf("%7s  %-20s %9s %9s %11s\n", "lights", "integrator", "MSE", "time", "efficiency");
  for (const int light_count : {1, 4, 10, 100, 1000, 10'000})
    compare(light_count, "path:max-depth=2", turns, reference);
  compare(1000, "path", turns, reference);
  costs(turns);
  compare_direction_sampling(turns);
}
