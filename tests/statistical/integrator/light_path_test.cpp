// Light paths as data structures of Metropolis light transport: bootstrap paths estimate the image mean, and mutations
// satisfy detailed balance.
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/mlt/bootstrap_paths.h"
#include "integrator/mlt/mutation_chain.h"
#include "support/integrator_scenes.h"

namespace etendue::light_path_test {
namespace {

using integrator::BootstrapPaths;
using integrator::ChainRandom;
using integrator::EdgeCounts;
using integrator::LightPath;
using integrator::Mutation;
using integrator::MutationPlan;
using integrator::PathShape;
using integrator::PathSpace;
using integrator::PathVertex;
using test::with;

using M = transport::AnyMedia<false>;

// The context of an integrator, without a renderer.
struct Fixture {
  explicit Fixture(const render::Document& d)
      : scene(scene::compile(d.scene, d.camera, nullptr)),
        model(transport::model_for(*scene)),
        camera(d.camera, d.width, d.height),
        filter(d.filter),
        context{scene.get(), &model, nullptr, &camera, &filter, 0, d.width, d.height} {}

  std::shared_ptr<const scene::CompiledScene> scene;
  transport::Model model;
  CameraRays camera;
  film::Filter filter;
  integrator::RenderContext context;
};

std::vector<std::pair<const char*, render::Document>> scenes() {
  return {{"cornell", test::cornell(test::kSize)},
          {"glossy scene", test::glossy_scene()},
          {"area light", test::balls_under_area_light()},
          {"sky", test::balls_under_sky()},
          {"point", test::balls_under_light("point")},
          {"spot", test::balls_under_light("spot")},
          {"directional through a lens", test::with_lens(test::balls_under_light("directional"))}};
}

constexpr integrator::LogUniform kPixels{0.1f, 4}, kAngles{1e-4f, 0.1f};

MutationPlan plan_with(std::array<float, integrator::kMutations> weights) {
  return {integrator::MutationChoice(weights), EdgeCounts(0), kPixels, kAngles, 5};
}

// The mean weight of bootstrap paths is the mean of the image, within 4.5 standard errors of either.
TEST(LightPaths, BootstrapPathsEstimateTheImageMean) {
  for (const auto& [name, d] : scenes()) {
    const Fixture fixture(d);
    PathSpace<M> space(fixture.context);
    LightPath<M> path;
    film::SplatFilter filter(fixture.filter, d.width, d.height);
    BootstrapPaths<M> paths(0);
    constexpr int kPaths = 200000;
    double sum = 0, squares = 0;
    for (int i = 0; i < kPaths; ++i) {
      ChainRandom random(mix_bits(uint64_t{7} + static_cast<uint64_t>(i)));
      double weight = paths.draw(space, random, path);
      const auto to = weight > 0 ? filter.choose(path.raster, random.next_2d()) : std::nullopt;
      weight = to ? weight * double{to->weight} * double{average(path.color)} : 0;
      sum += weight;
      squares += sqr(weight);
    }
    const double pixels = d.width * d.height, mean = sum / kPaths,
                 error = std::sqrt((squares / kPaths - sqr(mean)) / kPaths);
    const auto expected = test::mean_of(test::rendered(test::with_integrator(d, "bdpt"), 256));
    EXPECT_NEAR(mean / pixels, expected.value, 4.5 * (error / pixels + expected.standard_error)) << name;
  }
}

// The contribution f in the product area measure, from its definition.
double log_contribution(const LightPath<M>& x) {
  double f = std::log(x.brightness);
  for (int i = 1; i < x.edges(); ++i) f += std::log(double{x[i].value});
  for (int i = 0; i + 1 < x.edges(); ++i) f += std::log(x.cosine_to_camera(i) * x.inverse_square(i));
  const int last = x.edges() - 1;
  if (last > 0 || !x.light.infinite) f += std::log(x.cosine_to_camera(last) * double{x.importance});
  return f;
}

// Densities per area of x_{i+1} seen from x_i (ahead) and of x_{i-1} (back), for a unit density per solid angle.
double area_ahead(const LightPath<M>& y, int i) { return y.cosine_to_light(i + 1) * y.inverse_square(i); }
double area_back(const LightPath<M>& y, int i) {
  return i == 1 && y.light.infinite ? 1 : y.cosine_to_camera(i - 1) * y.inverse_square(i - 1);
}
double pixels_back(const LightPath<M>& y) {
  const int last = y.edges() - 1;
  return last == 0 && y.light.infinite ? 1 : double{y.importance} * y.cosine_to_camera(last);
}

// The density of sampling the vertices between l and m by two subpaths and a connection, from its definition; c is the
// last vertex of the light subpath.
double log_density(const LightPath<M>& y, int l, int m, int c, double area) {
  double p = 0;
  for (int i = l; i < c; ++i) {
    if (i < 0)
      p += std::log(double{y.light.first});
    else
      p += std::log((i == 0 ? double{y.light.second} : double{y[i].to_camera}) * area_ahead(y, i));
  }
  for (int i = m; i > c + 1; --i) {
    if (i == y.edges())
      p += std::log(pixels_back(y) / area);
    else if (i < y.edges())
      p += std::log(double{y[i].to_light} * area_back(y, i));
  }
  const bool possible = c < 0 ? y.light.extended : (c == 0 || !y[c].delta) && (c + 1 >= y.edges() || !y[c + 1].delta);
  const bool far = c == 0 && y.edges() == 1 && y.light.infinite && !(y.importance > 0);
  // For a directly visible infinite light, the measure is that of the image point.
  if (c == 0 && y.edges() == 1 && y.light.infinite) p -= std::log(double{y.importance});
  return possible && !far ? p : -kInfinity;
}

// The factors of f that do not change with the vertices between l and m, including the brightness.
double log_contribution_outside(const LightPath<M>& x, int l, int m) {
  double f = std::log(x.brightness);
  for (int i = 1; i < x.edges(); ++i)
    if (i < l || i > m) f += std::log(double{x[i].value});
  for (int i = 0; i + 1 < x.edges(); ++i)
    if (i < l || i >= m) f += std::log(x.cosine_to_camera(i) * x.inverse_square(i));
  const int last = x.edges() - 1;
  if (m <= last && (last > 0 || !x.light.infinite)) f += std::log(x.cosine_to_camera(last) * double{x.importance});
  // The light subpath contributes its cosine.
  if (l > 0) f += std::log(x.cosine_to_light(l));
  return f;
}

// The density of a replaced part, summed over all connecting edges, equals the closed form computed from f.
TEST(LightPaths, ReplacementDensityEqualsTheSumOverConnections) {
  for (const auto& [name, d] : scenes()) {
    const Fixture fixture(d);
    PathSpace<M> space(fixture.context);
    LightPath<M> x;
    BootstrapPaths<M> paths(0);
    const double area = double{space.image_area()};
    int found = 0;
    for (uint64_t i = 0; i < 3000; ++i) {
      ChainRandom random(i);
      if (!(paths.draw(space, random, x) > 0)) continue;
      for (int l = -1; l <= x.edges(); ++l)
        for (int m = l + 1; m <= x.edges() + 1; ++m) {
          if ((l < 0 && m < 1) || (m > x.edges() && l >= x.edges())) continue;
          double sum = 0;
          const double f = log_contribution(x), outside = log_contribution_outside(x, l, m);
          for (int c = l; c < m && c < x.edges(); ++c) sum += std::exp(log_density(x, l, m, c, area) - (f - outside));
          const double direct = x.density_between(l, m, area, [](int) { return 1; }) * x.brightness;
          if (direct == 0 && sum == 0) continue;
          EXPECT_NEAR(sum / direct, 1, 1e-4) << name << ' ' << l << ' ' << m << " of " << x.edges();
          ++found;
        }
    }
    EXPECT_GT(found, 1000) << name;
  }
}

// The density with which a perturbation proposes y, without factors that are symmetric in x and y.
double log_density(Mutation mutation, const PathShape& shape, const LightPath<M>& y) {
  double p = 0;
  if (mutation == Mutation::caustic) {
    for (int i = shape.caustic_start; i + 1 < y.edges(); ++i)
      p += std::log(area_ahead(y, i) * (i > shape.caustic_start ? double{y[i].projected_ratio} : 1));
    return p;
  }
  p = std::log(pixels_back(y));
  const int end = mutation == Mutation::chain ? shape.chain_end : shape.lens_end;
  for (int i = y.edges() - 1; i > end; --i) p += std::log(area_back(y, i));
  return p;
}

// Detailed balance f(x) T(x -> y) a(x -> y) = f(y) T(y -> x) a(y -> x): the acceptance ratio equals the ratio of f and
// T from their definitions. Rounding errors grow as edges become grazing.
TEST(LightPaths, PerturbationsSatisfyDetailedBalance) {
  std::array<int, integrator::kMutations> found{};
  for (const auto& [name, d] : scenes()) {
    const Fixture fixture(d);
    PathSpace<M> space(fixture.context);
    LightPath<M> x, y;
    BootstrapPaths<M> paths(0);
    const MutationPlan plan = plan_with({1, 1, 1, 1, 1});
    for (uint64_t i = 0; i < 80000; ++i) {
      ChainRandom random(i);
      if (!(paths.draw(space, random, x) > 0)) continue;
      const PathShape shape = shape_of(x);
      for (const Mutation m : {Mutation::lens, Mutation::caustic, Mutation::chain, Mutation::subpath}) {
        PathShape shape_there;
        if (plan.mutations.probability(m, shape) == 0) continue;
        const double ratio = propose(
            m, plan, space, x, shape, random, [&] { return random.next_2d(); }, y, shape_there);
        if (!(ratio > 0)) continue;
        EXPECT_EQ(shape.lens_end, shape_there.lens_end);
        EXPECT_EQ(shape.chain_end, shape_there.chain_end);
        const double expected =
            log_contribution(y) - log_density(m, shape, y) - log_contribution(x) + log_density(m, shape, x);
        EXPECT_NEAR(std::log(ratio), expected, 1e-4) << name << ' ' << static_cast<int>(m) << ' ' << x.edges();
        ++found[static_cast<size_t>(m)];
      }
    }
  }
  for (const Mutation m : {Mutation::lens, Mutation::caustic, Mutation::chain, Mutation::subpath})
    EXPECT_GT(found[static_cast<size_t>(m)], 20) << static_cast<int>(m);
}

// Log-uniform distribution [Lang, eq. 9.123]: density 1 / (r ln(r2 / r1)), mean (r2 - r1) / ln(r2 / r1), median sqrt(r1
// r2). Tolerances are 4.5 standard errors.
TEST(LightPaths, PerturbationDistancesAreLogUniform) {
  constexpr integrator::LogUniform kLaw{0.1f, 50};
  EXPECT_FLOAT_EQ(kLaw.sample(0), 50);
  EXPECT_NEAR(kLaw.sample(kOneMinusEpsilon), 0.1, 1e-6);
  ChainRandom random(1);
  constexpr int kNumbers = 100000;
  double sum = 0, squares = 0, below = 0;
  for (int i = 0; i < kNumbers; ++i) {
    const double r = double{glm::distance(integrator::perturb_raster({3, 4}, kLaw, random), Vec2(3, 4))};
    sum += r;
    squares += r * r;
    below += r < std::sqrt(5.0) ? 1 : 0;
  }
  const double mean = sum / kNumbers;
  EXPECT_NEAR(mean, 49.9 / std::log(500.0), 4.5 * std::sqrt((squares / kNumbers - sqr(mean)) / kNumbers));
  EXPECT_NEAR(below / kNumbers, 0.5, 4.5 * 0.5 / std::sqrt(kNumbers));
}

// The points of each chain are uniformly distributed. Those of all chains in one round are stratified over the image.
TEST(LightPaths, ChainsAreStratifiedOverTheImage) {
  constexpr uint32_t kChains = 64;
  for (uint32_t round = 0; round < 8; ++round) {
    std::array<int, kChains> columns{}, rows{};
    for (uint32_t chain = 0; chain < kChains; ++chain) {
      const Vec2 p = integrator::stratified_point(chain, kChains, round, 5);
      ++columns[static_cast<size_t>(p.x * kChains)];
      ++rows[static_cast<size_t>(p.y * kChains)];
    }
    for (uint32_t i = 0; i < kChains; ++i) {
      EXPECT_LE(std::abs(columns[i] - 1), 1);
      EXPECT_LE(std::abs(rows[i] - 1), 1);
    }
  }
}

// In the integrating sphere, paths of k > 1 edges have the share a rho^(k - 1), so that successive lengths have the
// ratio rho. The error is estimated from batches of chains; the tolerance is 4.5 standard errors.
TEST(LightPaths, PathLengthsInTheIntegratingSphere) {
  constexpr double kRho = 0.5;
  const Fixture fixture(test::integrating_sphere(0.1, 0.5f, scene::Cap::reflecting, 8));
  const MutationPlan plan = plan_with({1, 1, 1, 1, 1});
  integrator::MutationRunner<M> runner(fixture.context, plan);
  constexpr int kBatches = 24, kSteps = 20000, kMaxLength = 5;
  std::array<double, kMaxLength + 1> sum{}, squares{};
  film::Splats splats;
  for (int batch = 0; batch < kBatches; ++batch) {
    BootstrapPaths<M> paths(0);
    integrator::MutationChain<M> chain;
    chain.random = ChainRandom(static_cast<uint64_t>(batch));
    while (!(paths.draw(runner.space(), chain.random, chain.path) > 0)) continue;
    chain.shape = shape_of(chain.path);
    std::array<double, kMaxLength + 2> count{};
    for (int i = 0; i < kSteps; ++i) {
      splats.clear();
      runner.step(
          chain, 1, [&] { return chain.random.next_2d(); }, [](auto&&...) {}, splats);
      ++count[static_cast<size_t>(std::min(chain.path.edges(), kMaxLength + 1))];
    }
    for (size_t k = 2; k <= kMaxLength; ++k) {
      const double ratio = count[k] / count[2];
      sum[k] += ratio;
      squares[k] += ratio * ratio;
    }
  }
  for (int k = 3; k <= kMaxLength; ++k) {
    const auto i = static_cast<size_t>(k);
    const double mean = sum[i] / kBatches, error = std::sqrt((squares[i] / kBatches - sqr(mean)) / (kBatches - 1));
    EXPECT_NEAR(mean, std::pow(kRho, k - 2), 4.5 * error + 1e-3) << k;
  }
}

}  // namespace
}  // namespace etendue::light_path_test
