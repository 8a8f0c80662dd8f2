// Path tracing with a control variate for direct light        [Lang, sec. 6.5.3, 6.6.9; Kondapaneni et al. 2019]
//
// Path tracing with next event estimation and the balance heuristic. To the direct light B of the first vertex, a
// quantity with the expectation zero is added that is correlated with it:
//
//    L  ~  L_e + B + c K + ...,      K = a ( V p_b / (p_l + p_b) at a light sample  -  V p_l / (p_l + p_b) at a BSDF sample )
//
//   optimal   one c for each square of 8 x 8 pixels and each channel, for which the variance is least: the optimal MIS
//             weights of points that are lit alike [Kondapaneni et al. 2019, eq. 14]
//   ambient   c = -L_a, one radiance for the whole image, and K of the environment alone: light of the constant radiance
//             L_a is subtracted from the integrand, and its integral a L_a is added [Lang, eq. 6.468-6.472, corrected].
//             L_a is the radiance for which the variance is least
//
// c is learned from eight short paths per pixel before the first sample, with random numbers of their own. All samples
// are therefore independent and unbiased, and the result does not depend on how a rendering is divided.
//
//   Paths         E(D|G|S)*L; point lights: E.*(D|G)L
//   Bias          none
//   Cost          two rays per vertex, and once about four samples per pixel; 48 bytes per square
//   Limitations   The control is correlated only with noise that comes from sampling directions, not with that of
//                 shadows of small lights, of the pixel's area, or of indirect light. With path expressions, and with
//                 media in solids, c = 0. Samples may be negative, so fireflies are not re-weighted.
#include "integrator/control/control_coefficients.h"
#include "integrator/control/direct_light_control.h"
#include "integrator/integrator_base.h"
#include "integrator/registration.h"
#include "integrator/shared/camera_paths.h"

namespace etendue::integrator {

enum class ControlVariate : uint8_t { optimal, ambient };

}  // namespace etendue::integrator

template <>
struct etendue::Options<etendue::integrator::ControlVariate> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"optimal", "Optimal weights, per 8 x 8 pixels"}, {"ambient", "Ambient radiance"}}};
};

namespace etendue::integrator {

class PathTracingWithControl final : public IntegratorBase<PathTracingWithControl> {
 public:
  static IntegratorInfo info() {
    return {
        .name = "path-control",
        .label = "Path tracing with control variates",
        .summary = "Path tracing whose direct light has optimal MIS weights, or an ambient control variate",
        .group = Group::gathering,
        .paths = "E(D|G|S)*L",
        .point_paths = "E.*(D|G)L",
        .bias = Bias::unbiased,
        .cost = "2 rays per vertex, and once about 4 samples per pixel",
        .limitations =
            "Reduces only the noise of directions at the first vertex, not that of shadows of small lights or of "
            "indirect light. Point lights behind glass are never found.",
        .accumulation = Accumulation::per_image,
        .division = {DivisionUnit::passes, true, "Each part learns the coefficients of the control variate."},
        .negative_samples = true,
    };
  }

  Choice<ControlVariate> control{
      "control", "Control variate", ControlVariate::optimal,
      "optimal: optimal MIS weights of direct light, learned for each 8 x 8 pixels. ambient: "
      "one radiance of the environment is subtracted and added as its integral"};
  Number<int> roulette_start{"roulette-start",
                             "Russian roulette start depth",
                             4,
                             {1, 64},
                             "Path length from which paths are terminated at random, but not at their first vertex, "
                             "whose light has the control. Lower is faster and noisier"};

  using IntegratorBase::at_max_depth;

  auto parameters() { return std::tie(max_depth, control, roulette_start); }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState*) const final;
};

namespace {

class ControlState final : public RenderState {
 public:
  ControlState(const PathTracingWithControl& integrator, const RenderContext& context)
      : integrator_(integrator),
        context_(context),
        pilot_(context),
        columns_((context.width + PixelBlock::kWidth - 1) / PixelBlock::kWidth),
        rows_((context.height + PixelBlock::kHeight - 1) / PixelBlock::kHeight),
        coefficients_(context.width, context.height) {
    pilot_.seed = mix_bits(context.seed ^ kPilotSeed);
  }

  std::vector<Phase> phases(uint32_t) override {
    if (learned_) return {};
    return {{"learning the control variate", columns_ * rows_}};
  }
  std::optional<uint64_t> run(uint32_t, size_t, int task, const TaskContext& task_context) override {
    const PixelBlock block =
        block_containing(task % columns_ * PixelBlock::kWidth, task / columns_ * PixelBlock::kHeight, context_.width,
                         context_.height, 0);
    for (int y = 0; y < block.height; y += ControlCoefficients::kTile)
      for (int x = 0; x < block.width; x += ControlCoefficients::kTile)
        coefficients_.sums(block.x + x, block.y + y) = {};
    return transport::with_model(*context_.model, [&]<class M>(M) { return learn<M>(block, task_context); });
  }
  void finish(uint32_t, size_t) override {
    coefficients_.compute(integrator_.control == ControlVariate::ambient);
    learned_ = true;
  }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    return transport::with_model(*context_.model,
                                 [&]<class M>(M) { return sample_with<M>(block, radiance, task_context); });
  }

  size_t memory() const override { return coefficients_.memory(); }

 private:
  static constexpr uint64_t kPilotSeed = 0x434f4e54524f4cull;
  static constexpr uint32_t kPilotSamples = 4;

  ControlledLights controlled() const {
    return integrator_.control == ControlVariate::ambient ? ControlledLights::environment : ControlledLights::all;
  }

  // A path that roulette ended would have no BSDF sample, and its control an expectation other than zero.
  transport::RouletteSettings roulette_at_first_vertices() const {
    return std::max<int>(2, integrator_.roulette_start);
  }

  // Adds the sums of the tiles of a block; each of its terms is estimated by paths with the same random numbers.
  template <class M>
  std::optional<uint64_t> learn([[maybe_unused]] PixelBlock block, [[maybe_unused]] const TaskContext& task_context) {
    uint64_t rays = 0;
    if constexpr (kHasControl<M>) {
      static thread_local std::array<Rgb, PixelBlock::kMostPixels> difference, overlap, albedo;
      const PixelOrder order(block);
      for (block.sample = 0; block.sample < kPilotSamples; ++block.sample) {
        const auto first = estimate_term<M>(block, order, task_context, ControlTerm::difference, difference, albedo);
        const auto second = estimate_term<M>(block, order, task_context, ControlTerm::overlap, overlap, albedo);
        if (!first || !second) return {};
        rays += *first + *second;
        for (int i = 0; i < order.size(); ++i)
          coefficients_.sums(block.x + order.x(i), block.y + order.y(i)) +=
              {difference[order.index(i)], albedo[static_cast<size_t>(i)], overlap[order.index(i)]};
      }
    }
    return rays;
  }

  // `result` by pixels of the block, `albedos` by paths.
  template <class M>
  std::optional<uint64_t> estimate_term(const PixelBlock& block, const PixelOrder& order,
                                        const TaskContext& task_context, ControlTerm term, std::span<Rgb> result,
                                        PathCoefficients& albedos) const {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    launch_camera_paths(pilot_, block, order, task_context, paths);
    static thread_local PathCoefficients ones;
    ones.fill(Rgb(1));
    DirectLightControl<M> control(paths, controlled(), ones, term);
    if (paths.trace() && !integrator_.at_max_depth(1))
      while (paths.next_hits()) control.scatter(roulette_at_first_vertices());
    albedos = control.albedos();
    paths.trace();
    if (paths.length() == 2) {
      control.add_environment();
      while (paths.next_hits()) control.add_emission();
    }
    return collect(paths, order, result);
  }

  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) const {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    const PixelOrder order(block);
    launch_camera_paths(context_, block, order, task_context, paths);
    if constexpr (kHasControl<M>) {
      static thread_local PathCoefficients coefficients;
      for (int i = 0; i < order.size(); ++i)
        coefficients[static_cast<size_t>(i)] = coefficients_.at(block.x + order.x(i), block.y + order.y(i));
      estimate_with_control(paths, coefficients);
    } else {
      estimate_without_control(paths);
    }
    return collect(paths, order, radiance);
  }

  template <class M>
  void estimate_with_control(transport::PathWavefront<M>& paths, const PathCoefficients& coefficients) const {
    using namespace transport;
    constexpr MisHeuristic kBalance = MisHeuristic::balance;
    constexpr LightSampling kSampling = DirectLightControl<M>::kSampling;
    DirectLightControl<M> control(paths, controlled(), coefficients);
    while (paths.trace()) {
      add_environment(paths, kBalance, kSampling);
      while (paths.next_hits()) {
        if (paths.length() == 2)
          control.add_emission();
        else
          add_emission(paths, kBalance, kSampling);
        if (integrator_.at_max_depth(paths.length())) continue;
        if (paths.length() == 1) {
          control.scatter(roulette_at_first_vertices());
        } else {
          add_direct_light(paths, kSampling, kBalance);
          sample_bsdf(paths, integrator_.roulette_start);
        }
      }
    }
  }

  template <class M>
  void estimate_without_control(transport::PathWavefront<M>& paths) const {
    using namespace transport;
    constexpr MisHeuristic kBalance = MisHeuristic::balance;
    constexpr LightSampling kSampling = DirectLightControl<M>::kSampling;
    while (paths.trace()) {
      add_environment(paths, kBalance, kSampling);
      while (paths.next_hits()) {
        add_emission(paths, kBalance, kSampling);
        if (integrator_.at_max_depth(paths.length())) continue;
        add_direct_light(paths, kSampling, kBalance);
        sample_bsdf(paths, integrator_.roulette_start);
      }
    }
  }

  const PathTracingWithControl& integrator_;
  const RenderContext context_;
  RenderContext pilot_;
  const int columns_, rows_;
  ControlCoefficients coefficients_;
  bool learned_ = false;
};

}  // namespace

std::unique_ptr<RenderState> PathTracingWithControl::begin(const RenderContext& context, const RenderState*) const {
  return std::make_unique<ControlState>(*this, context);
}

Registration path_tracing_with_control() { return registration<PathTracingWithControl>(); }

}  // namespace etendue::integrator
