// The integrator `radiosity` against closed-form solutions and path tracing, and what it refuses and reuses.
//
// Images of `radiosity` are biased by the mesh. Comparisons allow 1 % for it, besides a statistical threshold with a
// false-alarm rate of at most 1e-4 per comparison (4 standard errors), and require standard errors below 0.5 %.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "film/film.h"
#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "render/prepared_document.h"
#include "support/scenes.h"

namespace etendue {
namespace {

render::Document with(const render::Document& d, const char* name, const std::string& value) {
  auto changed = render::with_text(d, name, value);
  EXPECT_TRUE(changed) << name << "=" << value;
  return *changed;
}

render::Document by_radiosity(const render::Document& d) {
  return with(with(with(d, "render.integrator", "radiosity"), "radiosity.patches", "1000"), "radiosity.rays", "256");
}

// Means over a grid of kBlocks x kBlocks parts of the image and its half-buffers.
constexpr int kBlocks = 4;
struct BlockMeans {
  std::array<double, kBlocks * kBlocks> mean{}, error{};
  double whole = 0, whole_error = 0;
};

double block_mean(const film::Film& film, int block) {
  const int width = film.width() / kBlocks, x0 = block % kBlocks * width, y0 = block / kBlocks * width;
  double sum = 0;
  for (int y = y0; y < y0 + width; ++y)
    for (int x = x0; x < x0 + width; ++x) sum += static_cast<double>(luminance(film.mean(x, y)));
  return sum / (width * width);
}

// Means and standard errors from six renderings with independent seeds.
BlockMeans measured(render::Document d, uint32_t samples) {
  constexpr int kRuns = 6;
  BlockMeans m;
  std::array<double, kBlocks * kBlocks> squares{};
  double whole_square = 0;
  for (int run = 0; run < kRuns; ++run) {
    d.seed = 100 + static_cast<uint64_t>(run);
    const film::Film film = test::rendered(d, samples);
    double whole = 0;
    for (int b = 0; b < kBlocks * kBlocks; ++b) {
      const double mean = block_mean(film, b);
      m.mean[static_cast<size_t>(b)] += mean / kRuns;
      squares[static_cast<size_t>(b)] += mean * mean / kRuns;
      whole += mean / (kBlocks * kBlocks);
    }
    m.whole += whole / kRuns;
    whole_square += whole * whole / kRuns;
  }
  for (size_t b = 0; b < m.mean.size(); ++b)
    m.error[b] = std::sqrt(std::max(0.0, squares[b] - sqr(m.mean[b])) / (kRuns - 1));
  m.whole_error = std::sqrt(std::max(0.0, whole_square - sqr(m.whole)) / (kRuns - 1));
  return m;
}

void expect_whole(const BlockMeans& a, const BlockMeans& b, double bias, const std::string& what,
                  double largest_error = 0.005) {
  const double error = std::hypot(a.whole_error, b.whole_error);
  EXPECT_LT(error, largest_error * b.whole) << what << ": the comparison is too noisy";
  EXPECT_NEAR(a.whole, b.whole, bias * b.whole + 4 * error) << what;
}

// A closed cube that emits radiance 1: L = 1 / (1 - rho).
TEST(RadiosityIntegrator, Furnace) {
  for (const double albedo : {0.3, 0.8}) {
    auto d = by_radiosity(test::document(test::furnace(static_cast<float>(albedo)), Camera(), 16, 16));
    d = with(d, "radiosity.patches", "200");
    for (const char* gather : {"none", "direct", "final"}) {
      const BlockMeans m = measured(with(d, "radiosity.gather", gather), 8);
      EXPECT_LT(m.whole_error, 0.004 * m.whole) << gather;
      EXPECT_NEAR(m.whole * (1 - albedo), 1, 0.001 + 4 * m.whole_error * (1 - albedo)) << gather;
    }
  }
}

// A sphere with a point light of intensity I in its centre: its irradiance is 4 pi I / (A (1 - rho)), with the area A of
// the mesh.
TEST(RadiosityIntegrator, SphereAroundAPointLight) {
  constexpr double kAlbedo = 0.6, kIntensity = 5;
  const auto mesh = scene::sphere(1, 16, true);
  double area = 0;
  for (const Triangle& t : mesh->triangles)
    area += 0.5 * static_cast<double>(glm::length(glm::cross(mesh->positions[t[1]] - mesh->positions[t[0]],
                                                             mesh->positions[t[2]] - mesh->positions[t[0]])));
  scene::Scene s;
  test::add(s, mesh, test::diffuse(Rgb(static_cast<float>(kAlbedo))));
  test::add_point_light(s, {0, 0, 0}, static_cast<float>(kIntensity));
  const auto d = by_radiosity(test::document(std::move(s), Camera(), 16, 16));
  const double expected = kAlbedo * 4 * kIntensity / (area * (1 - kAlbedo));
  for (const char* gather : {"none", "direct", "final"}) {
    const BlockMeans m = measured(with(d, "radiosity.gather", gather), 8);
    EXPECT_LT(m.whole_error, 0.002 * m.whole) << gather;
    EXPECT_NEAR(m.whole, expected, 0.005 * expected + 4 * m.whole_error) << gather;
  }
}

// All surfaces of the box are diffuse, so that path tracing computes the same paths, ED*L.
TEST(RadiosityIntegrator, CornellBoxAgreesWithPathTracing) {
  const auto d = test::cornell(32);
  const BlockMeans path = measured(with(d, "film.paths", "ED*L"), 192);
  const auto radiosity = with(with(by_radiosity(d), "radiosity.patches", "1500"), "radiosity.gather", "final");
  const BlockMeans final_gathering = measured(radiosity, 128);
  expect_whole(final_gathering, path, 0.01, "final gathering");
  for (size_t b = 0; b < path.mean.size(); ++b) {
    const double error = std::hypot(path.error[b], final_gathering.error[b]);
    EXPECT_LT(error, 0.015 * path.mean[b]) << "block " << b;
    EXPECT_NEAR(final_gathering.mean[b], path.mean[b], 0.01 * path.mean[b] + 4 * error) << "block " << b;
  }
  expect_whole(measured(with(radiosity, "radiosity.gather", "direct"), 64), path, 0.01, "direct light");
  expect_whole(measured(with(radiosity, "radiosity.gather", "none"), 64), path, 0.01, "patches");
  expect_whole(measured(with(with(radiosity, "radiosity.gather", "none"), "radiosity.reconstruction", "linear"), 64),
               path, 0.02, "linear reconstruction");
}

// Point light and environment enter as direct irradiance.
TEST(RadiosityIntegrator, OtherLights) {
  scene::Scene s;
  test::add(s, test::quad(2), test::diffuse(Rgb(0.6f)));
  test::add(s, scene::box({0.4f, 0.4f, 0.4f}), test::diffuse(Rgb(0.7f, 0.3f, 0.2f)),
            Mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5f, 0.5f, 0, 1));
  test::add_point_light(s, {-1, 2, 1}, 10);
  s.environment.tint = Rgb(0.4f);
  auto d = test::document(std::move(s), look_at({0, 3, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f), 32, 32);
  d = with(d, "film.paths", "ED*L");
  const BlockMeans path = measured(d, 256);
  for (const char* gather : {"none", "direct", "final"})
    expect_whole(measured(with(by_radiosity(d), "radiosity.gather", gather), 128), path, 0.01, gather);
}

// Path expressions and the maximum length select reflections: the parts add up to the whole, and each agrees with path
// tracing.
TEST(RadiosityIntegrator, PathClasses) {
  const auto d = test::cornell(32);
  constexpr std::array<const char*, 4> kClasses{"EL", "EDL", "EDDL", "EDDD+L"};
  std::array<BlockMeans, 4> path;
  for (size_t k = 0; k < 4; ++k) path[k] = measured(with(d, "film.paths", kClasses[k]), 128);
  for (const char* gather : {"none", "final"}) {
    const auto radiosity = with(with(by_radiosity(d), "radiosity.patches", "400"), "radiosity.gather", gather);
    double sum = 0;
    for (size_t k = 0; k < 4; ++k) {
      const BlockMeans part = measured(with(radiosity, "film.paths", kClasses[k]), 32);
      expect_whole(part, path[k], 0.02, std::string(gather) + " " + kClasses[k], 0.02);
      sum += part.whole;
    }
    EXPECT_NEAR(sum, measured(radiosity, 32).whole, 2e-3 * sum) << gather;
    const BlockMeans two = measured(with(radiosity, "radiosity.max-depth", "3"), 32);
    expect_whole(two, measured(with(radiosity, "film.paths", "E[D][D]L"), 32), 1e-5, "max-depth");
  }
}

TEST(RadiosityIntegrator, AllSolversGiveTheSameImage) {
  auto d = with(by_radiosity(test::cornell(16)), "radiosity.patches", "300");
  d = with(d, "radiosity.tolerance", "1e-8");
  const auto reference = test::rendered(with(d, "radiosity.solver", "direct"), 2);
  for (const char* solver : {"gauss-seidel", "jacobi", "neumann", "sor", "cg", "southwell", "progressive"}) {
    const auto film = test::rendered(with(d, "radiosity.solver", solver), 2);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(film.mean(x, y)[c], reference.mean(x, y)[c], 1e-5f * (1 + reference.mean(x, y)[c])) << solver;
  }
}

TEST(RadiosityIntegrator, SameBitsForAnyNumberOfThreads) {
  for (const char* gather : {"none", "final"}) {
    const auto d = with(with(by_radiosity(test::cornell(32)), "radiosity.patches", "200"), "radiosity.gather", gather);
    const auto one = test::rendered(d, 3, 1);
    for (const int threads : {2, 7}) EXPECT_TRUE(test::same_bits(one, test::rendered(d, 3, threads))) << gather;
  }
  const auto adaptive = with(by_radiosity(test::cornell(32)), "radiosity.meshing", "adaptive");
  EXPECT_TRUE(test::same_bits(test::rendered(adaptive, 3, 1), test::rendered(adaptive, 3, 2)));
}

// Adaptive meshes put patches where direct light has shadows: with the same number of patches the direct light of the
// Cornell box has a smaller error, and the mean is that of path tracing.
TEST(RadiosityIntegrator, AdaptiveMeshesShowShadowsBetter) {
  const auto d = with(by_radiosity(test::cornell(64)), "radiosity.light-samples", "256");
  const auto direct = with(d, "film.paths", "EDL");
  const film::Film reference = test::rendered(with(direct, "render.integrator", "path"), 1024);
  const auto error = [&](const char* meshing) {
    const film::Film film = test::rendered(with(direct, "radiosity.meshing", meshing), 64);
    double sum = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const double truth = luminance(reference.mean(x, y)), difference = luminance(film.mean(x, y)) - truth;
        sum += sqr(difference) / (sqr(truth) + 0.01);
      }
    return sum;
  };
  EXPECT_LT(error("adaptive"), 0.8 * error("area"));
  const auto whole = test::cornell(32);
  expect_whole(
      measured(with(with(by_radiosity(whole), "radiosity.meshing", "adaptive"), "radiosity.patches", "1500"), 64),
      measured(with(whole, "film.paths", "ED*L"), 192), 0.01, "adaptive");
}

// A rendering without a session, to count its phases and rays.
class Rendering {
 public:
  explicit Rendering(const render::Document& d, const Rendering* previous = nullptr)
      : scene_(scene::compile(d.scene, d.camera, previous ? previous->scene_ : nullptr)),
        prepared_(d, scene_),
        state_(prepared_.begin(prepared_.context(), previous ? previous->state_.get() : nullptr)) {}

  // The rays of all phases of the first sample.
  uint64_t prepare() {
    uint64_t rays = 0;
    const auto phases = state_->phases(0);
    for (size_t p = 0; p < phases.size(); ++p) {
      const int tasks = state_->task_count(0, p, phases[p].tasks);
      for (int task = 0; task < tasks; ++task) rays += *state_->run(0, p, task, {});
      state_->finish(0, p);
    }
    return rays;
  }
  // A phase of the first sample, as planned before.
  void run_phase(size_t phase) {
    const int tasks = state_->task_count(0, phase, 1);
    for (int task = 0; task < tasks; ++task) EXPECT_TRUE(state_->run(0, phase, task, {}));
    state_->finish(0, phase);
  }
  // The first sample of 16 x 16 pixels.
  std::vector<Rgb> pixels() {
    prepare();
    std::vector<Rgb> radiance(256);
    EXPECT_TRUE(state_->sample({.x = 0, .y = 0, .width = 16, .height = 16, .sample = 0}, radiance, {}));
    return radiance;
  }
  bool has_phases() const { return remaining_phases() > 0; }
  size_t remaining_phases() const { return state_->phases(0).size(); }
  integrator::RenderState& state() { return *state_; }

 private:
  std::shared_ptr<const scene::CompiledScene> scene_;
  render::PreparedDocument prepared_;
  std::unique_ptr<integrator::RenderState> state_;
};

TEST(RadiosityIntegrator, ReusesWhatAnEditDoesNotChange) {
  const auto d =
      with(with(by_radiosity(test::cornell(16)), "radiosity.patches", "200"), "radiosity.light-samples", "4");
  Rendering first(d);
  const uint64_t rays = first.prepare();
  EXPECT_GT(rays, 100'000u);
  auto moved = d;
  moved.camera.to_world[3].x += 0.1f;
  EXPECT_FALSE(Rendering(moved, &first).has_phases()) << "a camera move computes nothing";
  EXPECT_FALSE(Rendering(with(d, "radiosity.gather", "final"), &first).has_phases());
  // Reflectance and lights: form factors stay, shadow rays are traced again.
  for (const auto& [name, value] : {std::pair{"material.1.base-color.r", "0.2"}, {"material.3.emission.r", "3"}}) {
    Rendering edited(with(d, name, value), &first);
    EXPECT_TRUE(edited.has_phases()) << name;
    const uint64_t again = edited.prepare();
    EXPECT_GT(again, 0u) << name;
    EXPECT_LT(again, rays / 20) << name;
    Rendering fresh(with(d, name, value));
    fresh.prepare();
    EXPECT_EQ((*edited.state().points())[7].power, (*fresh.state().points())[7].power) << name;
  }
  // An adaptive mesh follows the light, but not the camera.
  const auto adaptive = with(d, "radiosity.meshing", "adaptive");
  Rendering refined(adaptive);
  refined.prepare();
  EXPECT_FALSE(Rendering(with(adaptive, "camera.yfov", "0.5"), &refined).has_phases());
  const auto other_light = with(adaptive, "material.3.emission.r", "3");
  EXPECT_EQ(Rendering(other_light, &refined).pixels(), Rendering(other_light).pixels());
  // Another mesh.
  EXPECT_GT(Rendering(with(d, "radiosity.patches", "100"), &first).prepare(), rays / 4);
}

// After an edit, two states may share a solution that is not ready; either of them completes it for both.
TEST(RadiosityIntegrator, SharesASolutionThatIsNotReady) {
  for (const char* meshing : {"area", "adaptive"}) {
    const auto d =
        with(with(by_radiosity(test::cornell(16)), "radiosity.patches", "100"), "radiosity.meshing", meshing);
    auto moved = d;
    moved.camera.to_world[3].x += 0.1f;
    Rendering first(d), second(moved, &first);
    // The phases of the first one are planned before the other one makes them superfluous.
    const size_t planned = first.remaining_phases();
    EXPECT_EQ(second.pixels(), Rendering(moved).pixels());
    for (size_t phase = 0; phase < planned; ++phase) first.run_phase(phase);
    EXPECT_FALSE(first.has_phases());
    EXPECT_EQ(first.pixels(), Rendering(d).pixels());
  }
}

std::string refusal(const render::Document& d) {
  return render::incompatibility(with(d, "render.integrator", "radiosity"),
                                 *scene::compile(d.scene, d.camera, nullptr));
}

TEST(RadiosityIntegrator, RefusesWhatItDoesNotSupport) {
  const auto cornell = test::cornell(8);
  EXPECT_EQ(refusal(cornell), "");
  EXPECT_NE(refusal(*render::new_document("cornell-spheres")).find("is not diffuse"), std::string::npos);
  EXPECT_EQ(refusal(with(*render::new_document("glossy-plates"), "radiosity.surfaces", "base-color")), "");
  EXPECT_NE(refusal(*render::new_document("fog")).find("scattering media"), std::string::npos);
  EXPECT_NE(refusal(with(cornell, "radiosity.memory-limit", "1")).find("patches fit"), std::string::npos);
  EXPECT_NE(refusal(with(cornell, "radiosity.patches", "1000000")).find("patches fit"), std::string::npos);
  // A refused image is black.
  const auto black = with(with(cornell, "render.integrator", "radiosity"), "radiosity.memory-limit", "1");
  EXPECT_EQ(test::mean_of(test::rendered(black, 2)).value, 0);
}

// Scenes without light or without surfaces, and a closed room of reflectance 1.
TEST(RadiosityIntegrator, UnusualScenes) {
  scene::Scene empty, dark;
  test::add(dark, test::quad(1), test::diffuse(Rgb(0.5f)));
  for (auto* s : {&empty, &dark}) s->environment.tint = Rgb(0);
  const auto camera = look_at({0, 3, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f);
  EXPECT_EQ(test::mean_of(test::rendered(by_radiosity(test::document(empty, camera, 8, 8)), 2)).value, 0);
  EXPECT_EQ(test::mean_of(test::rendered(by_radiosity(test::document(dark, camera, 8, 8)), 2)).value, 0);
}

std::vector<std::string> notes_of(const render::Document& d) {
  Rendering rendering(d);
  rendering.prepare();
  return rendering.state().notes();
}

// A room that reflects all light has no solution: a note says so, and the image shows emitted and direct light.
TEST(RadiosityIntegrator, DivergenceIsReported) {
  const auto room = [](float albedo) {
    return with(by_radiosity(test::document(test::furnace(albedo), Camera(), 8, 8)), "radiosity.patches", "50");
  };
  EXPECT_TRUE(notes_of(room(0.5f)).empty());
  const auto notes = notes_of(room(1));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("direct light only"), std::string::npos) << notes[0];
  // Direct light is sampled with 64 shadow rays per element.
  EXPECT_NEAR(test::mean_of(test::rendered(room(1), 2)).value, 2, 0.03);
}

TEST(RadiosityIntegrator, ApproximatedMaterialsAreReported) {
  const auto plates = with(with(by_radiosity(*render::new_document("glossy-plates")), "radiosity.patches", "50"),
                           "radiosity.surfaces", "base-color");
  const auto notes = notes_of(plates);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("is not diffuse"), std::string::npos) << notes[0];
}

// The sampler of the document draws the rays of form factors and direct light.
TEST(RadiosityIntegrator, UsesTheSampler) {
  const auto d = with(with(by_radiosity(test::cornell(16)), "radiosity.patches", "200"), "radiosity.rays", "32");
  const Rgb by_sobol = (*[&] {
                         Rendering r(d);
                         r.prepare();
                         return r.state().points();
                       }())[7]
                           .power;
  for (const char* sampler : {"random", "halton", "stratified", "lattice"}) {
    Rendering first(d);
    first.prepare();
    const auto other = with(d, "render.sampler", sampler);
    Rendering edited(other, &first);
    EXPECT_TRUE(edited.has_phases()) << sampler;
    edited.prepare();
    const Rgb power = (*edited.state().points())[7].power;
    EXPECT_NE(power, by_sobol) << sampler;
    EXPECT_NEAR(luminance(power), luminance(by_sobol), 0.3f * luminance(by_sobol)) << sampler;
  }
}

// Tasks that are stopped and continued, as after an edit of a preview, give the same bits, and a solution that was
// partly computed for another state is completed.
TEST(RadiosityIntegrator, CanBeStoppedAtAnyPoint) {
  for (const char* meshing : {"area", "adaptive"}) {
    const auto d =
        with(with(by_radiosity(test::cornell(16)), "radiosity.patches", "300"), "radiosity.meshing", meshing);
    const auto expected = Rendering(d).pixels();
    Rendering first(d);
    int polls = 0;
    const std::function<bool()> sometimes = [&] { return ++polls % 7 != 0; };
    integrator::RenderState& state = first.state();
    const auto phases = state.phases(0);
    int stopped = 0;
    for (size_t p = 0; p < phases.size(); ++p) {
      const int tasks = state.task_count(0, p, phases[p].tasks);
      for (int task = 0; task < tasks; ++task)
        while (!state.run(0, p, task, {.keep_going = &sometimes})) ++stopped;
      state.finish(0, p);
      if (p == 1) {
        EXPECT_LT(Rendering(d, &first).remaining_phases(), phases.size());
      }
    }
    EXPECT_GT(stopped, 10) << meshing;
    EXPECT_EQ(first.pixels(), expected) << meshing;
  }
}

// The stated error includes the variance of form factors and direct light: it must not be zero.
TEST(RadiosityIntegrator, TheStatedErrorIncludesTheFormFactors) {
  auto d = with(by_radiosity(test::cornell(32)), "radiosity.patches", "300");
  d = with(with(d, "radiosity.rays", "32"), "radiosity.light-samples", "4");
  const film::Film film = test::rendered(d, 64);
  double squares = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      squares += static_cast<double>(sqr(luminance(film.half_buffer_mean(x, y, 0) - film.half_buffer_mean(x, y, 1))));
  const double difference = std::sqrt(squares / (32 * 32)), mean = test::mean_of(film).value;
  EXPECT_GT(difference, 0.01 * mean);
  EXPECT_LT(difference, 0.5 * mean);
}

}  // namespace
}  // namespace etendue
