// Radiosity                        [Lang, sec. 10.1, eq. 10.13-10.36, corrected; Goral et al. 1984; Cohen et al. 1988]
//
// The triangles of the scene are divided into patches i with constant irradiance H_i, which satisfies
//
//    H_i  =  E_i  +  sum over j  F_ij rho_j H_j
//
// E is direct irradiance, estimated by shadow rays; rho is reflectance; the form factor F_ij is the fraction of the
// power leaving patch i that arrives at patch j. The system is solved once. Images then look up H where camera rays
// hit:
//
//    gather = none     L  =  L_e  +  rho / pi  H
//    gather = direct   L  =  L_e  +  sampled direct light  +  rho / pi  (H - E)
//    gather = final    L  =  L_e  +  sampled direct light  +  rho_x rho_y / pi  H_y    with y on a cosine-distributed ray
//
// Each half-buffer has a solution of its own, so the error estimate includes the variance of form factors and direct
// light. It cannot include the bias of the mesh. Solutions are reused while only the camera changes, form factors while
// the geometry stays.
//
//   Paths         ED*L; point lights: ED+L
//   Bias          biased: irradiance is constant over a patch, or linear between vertices; shadows blur and light leaks by
//                 the size of a patch. Smaller patches reduce it
//   Cost          first the form factor rays of every patch side, twice, and 8 bytes per factor; then 1 to 4 rays per
//                 sample
//   Limitations   Diffuse surfaces only. Shadows and details below the size of a patch are missing unless they are
//                 gathered.
#include "integrator/integrator_base.h"
#include "integrator/radiosity/solution_display.h"
#include "integrator/registration.h"
#include "integrator/shared/camera_paths.h"
#include "radiosity/mesh_refinement.h"
#include "radiosity/parameters.h"
#include "radiosity/reconstruction.h"
#include "radiosity/reflectance.h"
#include "scene/facet.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::integrator {

enum class RadiosityGather { none, direct_light, final_gathering };
enum class RadiositySurfaces { diffuse_only, base_color };

}  // namespace etendue::integrator

template <>
struct etendue::Options<etendue::integrator::RadiosityGather> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"none", "None"}, {"direct", "Direct light"}, {"final", "Final gathering"}}};
};

template <>
struct etendue::Options<etendue::integrator::RadiositySurfaces> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"diffuse", "Diffuse only"}, {"base-color", "All, by base colour"}}};
};

namespace etendue::integrator {

class Radiosity final : public IntegratorBase<Radiosity>, public radiosity::Parameters {
 public:
  static IntegratorInfo info() {
    return {
        .name = "radiosity",
        .label = "Radiosity",
        .summary = "The radiosity equation of a mesh of patches, solved once and looked up from the camera",
        .group = Group::two_pass,
        .paths = "ED*L",
        .point_paths = "ED+L",
        .bias = Bias::biased,
        .cost =
            "first the form factor rays of every patch side, twice, and 8 bytes per factor; then 1 to 4 rays per "
            "sample",
        .limitations =
            "Diffuse surfaces only. For any number of samples: shadows blur and light leaks by the size of a "
            "patch; smaller patches reduce it.",
        .accumulation = Accumulation::per_image,
        .division = {DivisionUnit::passes, true, "Each part computes the same solution again."},
    };
  }

  Choice<radiosity::Reconstruction> reconstruction{
      "reconstruction", "Reconstruction", radiosity::Reconstruction::constant,
      "Constant shows the patches; linear interpolates between their vertices and is smoother"};
  Choice<RadiosityGather> gather{"gather", "Gathering", RadiosityGather::none,
                                 "None: shows the patches. Direct: samples direct light, for exact shadows. Final: "
                                 "also samples the last reflection, "
                                 "which hides the patches and adds noise"};
  Choice<RadiositySurfaces> surfaces{"surfaces", "Surfaces", RadiositySurfaces::diffuse_only,
                                     "Whether scenes with other than diffuse surfaces are refused, or all surfaces are "
                                     "taken as diffuse with their base colour"};
  using IntegratorBase::at_max_depth;

  auto parameters() {
    return std::tuple_cat(std::tie(max_depth, gather, reconstruction, surfaces), solution_parameters());
  }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const final;
  std::string incompatibility(const RenderContext& context) const override;

  radiosity::SolutionPlan plan_for(const RenderContext& context, uint32_t half) const;

 private:
  radiosity::CountedReflections counted_reflections(const transport::Model& model) const;
};

std::string Radiosity::incompatibility(const RenderContext& context) const {
  const scene::CompiledScene& scene = *context.scene;
  if (!scene.solids().empty())
    return "it does not support media between surfaces, so the image will be black: use another integrator";
  if (surfaces == RadiositySurfaces::diffuse_only)
    if (const std::string name = radiosity::non_diffuse_material(scene); !name.empty())
      return name +
             " is not diffuse, so the image will be black: use another integrator, or set radiosity.surfaces to "
             "base-color, which takes all surfaces as diffuse";
  if (const std::string moving = scene.moving(); context.model->moving && !moving.empty() && moving != "the camera")
    return moving +
           " moves while the shutter is open, so the image will be black: close the shutter (camera.shutter=0) "
           "or use another integrator";
  const std::string reason = radiosity::too_many_patches(scene, *this, film::kHalfBuffers);
  return reason.empty() ? reason : "the image will be black, because " + reason;
}

radiosity::SolutionPlan Radiosity::plan_for(const RenderContext& context, uint32_t half) const {
  radiosity::SolutionPlan made =
      plan(mix_bits(context.seed * film::kHalfBuffers + half + 1),
           {std::string(context.sampler_name), {context.sampler_settings.begin(), context.sampler_settings.end()}});
  made.field.counted = counted_reflections(*context.model);
  return made;
}

// A path of n reflections has n + 1 edges. An automaton with few states repeats itself long before kMost.
radiosity::CountedReflections Radiosity::counted_reflections(const transport::Model& model) const {
  using transport::Event;
  constexpr size_t kMost = 1000;
  radiosity::CountedReflections counted(kMost + 1, true);
  transport::Automaton::State state = 0;
  const transport::Automaton* automaton = model.classes ? &model.paths->automaton() : nullptr;
  if (automaton) state = automaton->next(automaton->start(), Event::camera);
  bool all = true;
  for (size_t n = 0; n <= kMost; ++n) {
    const bool matches = !automaton || automaton->accepts(automaton->next(state, Event::light));
    counted[n] = matches && (max_depth == 0 || n + 1 <= static_cast<size_t>(max_depth));
    all = all && (counted[n] || n == 0);
    if (automaton) state = automaton->next(state, Event::diffuse);
  }
  return all ? radiosity::CountedReflections() : counted;
}

namespace {

// A solution per half-buffer, and the values that images look up.
class RadiosityState final : public RenderState {
 public:
  RadiosityState(const Radiosity& integrator, const RenderContext& context, const RadiosityState* previous)
      : integrator_(integrator), context_(context), is_refused_(!integrator.incompatibility(context).empty()) {
    if (is_refused_) return;
    for (uint32_t half = 0; half < film::kHalfBuffers; ++half) plans_[half] = integrator.plan_for(context, half);
    const radiosity::MeshSettings settings = integrator.mesh_settings();
    if (settings.meshing != radiosity::Meshing::adaptive) {
      mesh_ = radiosity::PatchMesh(*context.scene, settings);
    } else if (previous && can_reuse_mesh(*previous, settings)) {
      refinement_ = previous->refinement_;
    } else {
      refinement_ = std::make_shared<radiosity::MeshRefinement>(*context.scene, settings, context.seed);
    }
    if (has_mesh()) begin_solutions(previous);
  }

  std::vector<Phase> phases(uint32_t sample) override {
    if (is_refused_) return {};
    const uint32_t half = sample % film::kHalfBuffers;
    std::vector<Phase> list;
    first_round_ = has_mesh() ? 0 : refinement_->round();
    rounds_ = has_mesh() ? 0 : static_cast<size_t>(radiosity::MeshRefinement::kRounds - first_round_);
    if (rounds_ > 0) {
      // The tasks of the stages follow from the mesh.
      list.assign(rounds_, {"refining the mesh", refinement_->tasks()});
      for (const char* name : radiosity::SceneSolution::stage_names()) list.push_back({name, 0});
      first_stage_[half] = 0;
      return list;
    }
    // Another state has refined the mesh.
    if (!solutions_[half]) begin_solutions(nullptr);
    for (const auto& stage : solution(sample).stages()) list.push_back({stage.name, stage.tasks});
    first_stage_[half] = solution(sample).first_stage();
    // Another state has completed the solution: that of an earlier image, or of a preview.
    if (list.empty() && lookups_[half].at_camera.empty()) prepare_lookup(half);
    return list;
  }
  int task_count(uint32_t sample, size_t phase, int planned) override {
    if (phase < rounds_) return is_round_done(phase) ? 0 : refinement_->tasks();
    return rounds_ > 0 ? solution(sample).tasks_of(stage_of(sample, phase)) : planned;
  }
  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const TaskContext& task_context) override {
    if (phase < rounds_)
      return is_round_done(phase) ? 0 : refinement_->run(*context_.scene, task, task_context.keep_going);
    return solution(sample).run_stage(*context_.scene, mesh(), stage_of(sample, phase), task, task_context.keep_going);
  }
  void finish(uint32_t sample, size_t phase) override {
    if (phase < rounds_) {
      if (!is_round_done(phase)) refinement_->finish_round(*context_.scene);
      if (has_mesh() && !solutions_[0]) begin_solutions(nullptr);
      return;
    }
    solution(sample).complete_stage(mesh(), reflectance_, stage_of(sample, phase));
    if (solution(sample).is_ready()) prepare_lookup(sample % film::kHalfBuffers);
  }

  std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                 const TaskContext& task_context) override {
    if (is_refused_) {
      std::ranges::fill(radiance, Rgb(0));
      return 0;
    }
    // All surfaces are taken as diffuse, whatever lobes the model of the scene has.
    if (context_.model->classes) return sample_with<transport::DiffuseVacuum<true>>(block, radiance, task_context);
    return sample_with<transport::DiffuseVacuum<false>>(block, radiance, task_context);
  }

  size_t memory() const override {
    size_t bytes = mesh().memory() + vertices_.memory() + reflectance_.capacity() * sizeof(Rgb);
    for (const auto& solution : solutions_) bytes += solution ? solution->memory() : 0;
    for (const Lookup& lookup : lookups_)
      bytes += (lookup.at_camera.capacity() + lookup.at_gather.capacity()) * sizeof(Rgb);
    return bytes;
  }

  std::shared_ptr<const std::vector<StoredPoint>> points() const override {
    if (!is_ready()) return std::make_shared<const std::vector<StoredPoint>>();
    return patch_points(mesh(), reflectance_, *solutions_[0], kMostPoints);
  }

  std::vector<Statistic> statistics() const override {
    if (!is_ready()) return {};
    return solution_statistics(mesh(), vertices_, *solutions_[0]);
  }

  std::vector<std::string> notes() const override {
    if (is_refused_) return {};
    std::vector<std::string> list;
    if (const std::string name = radiosity::non_diffuse_material(*context_.scene); !name.empty())
      list.push_back(name + " is not diffuse: radiosity takes all surfaces as diffuse with their base colour");
    for (const auto& solution : solutions_) {
      if (!solution || !solution->is_ready() || solution->field().problem.empty()) continue;
      const auto& field = solution->field();
      list.push_back("radiosity: " + field.problem +
                     (field.has_diverged ? ". The image shows emitted and direct light only" : ""));
      break;
    }
    return list;
  }

  std::shared_ptr<const SolutionView> solution_view() const override {
    if (is_refused_) return nullptr;
    if (!solutions_[0]) return std::make_shared<const SolutionView>();  // the mesh is being refined
    auto view = view_of(mesh(), reflectance_, *solutions_[0]);
    view->solver = Options<radiosity::SolverKind>::kOptions[static_cast<size_t>(integrator_.solver.value)].label;
    return view;
  }

 private:
  // What the images of one half-buffer look up: by element, or by vertex.
  struct Lookup {
    std::vector<Rgb> at_camera, at_gather;
  };

  bool is_ready() const { return solutions_[0] && solutions_[0]->is_ready(); }
  bool has_mesh() const { return !refinement_ || refinement_->is_ready(); }
  const radiosity::PatchMesh& mesh() const { return refinement_ ? refinement_->mesh() : mesh_; }
  // Another state may have refined the mesh meanwhile.
  bool is_round_done(size_t phase) const { return first_round_ + static_cast<int>(phase) < refinement_->round(); }
  // The stage of the solution that a phase after the rounds of refinement runs.
  size_t stage_of(uint32_t sample, size_t phase) const {
    return first_stage_[sample % film::kHalfBuffers] + phase - rounds_;
  }

  // `previous` may be null.
  void begin_solutions(const RadiosityState* previous) {
    reflectance_ = radiosity::patch_reflectances(*context_.scene, mesh());
    if (integrator_.reconstruction == radiosity::Reconstruction::linear) vertices_ = radiosity::PatchVertices(mesh());
    for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
      if (previous && can_reuse_solution(*previous, half)) {
        solutions_[half] = previous->solutions_[half];
      } else {
        solutions_[half] = std::make_shared<radiosity::SceneSolution>(
            plans_[half], mesh().element_count(), previous ? reusable_factors(*previous, half) : nullptr);
      }
    }
  }

  radiosity::SceneSolution& solution(uint32_t sample) { return *solutions_[sample % film::kHalfBuffers]; }

  static bool has_same_sampler(const radiosity::SamplerChoice& a, const radiosity::SamplerChoice& b) {
    const auto is_same = [](const Setting& x, const Setting& y) { return x.name == y.name && x.value == y.value; };
    return a.name == b.name && std::ranges::equal(a.settings, b.settings, is_same);
  }
  // A refinement that is not ready is continued.
  bool can_reuse_mesh(const RadiosityState& previous, const radiosity::MeshSettings& settings) const {
    return previous.refinement_ && previous.refinement_->is_same(settings, context_.seed) &&
           context_.scene->same_light(*previous.context_.scene);
  }
  bool has_same_factors(const RadiosityState& previous, uint32_t half) const {
    const scene::CompiledScene &a = *context_.scene, &b = *previous.context_.scene;
    const bool same_light = a.same_light(b);
    // Opacity and analytic shapes block rays as well.
    const bool same_blockers = same_light || (!a.has_transparency() && !b.has_transparency() &&
                                              mesh().quality().shapes == 0 && previous.mesh().quality().shapes == 0);
    const radiosity::SolutionPlan &p = plans_[half], &q = previous.plans_[half];
    return same_blockers && p.factors == q.factors && p.seed == q.seed && has_same_sampler(p.sampler, q.sampler) &&
           mesh() == previous.mesh();
  }
  // A solution that is not ready has been started with the same tasks, which run again.
  bool can_reuse_solution(const RadiosityState& previous, uint32_t half) const {
    if (previous.is_refused_ || !previous.solutions_[half] || !has_same_factors(previous, half)) return false;
    const radiosity::SolutionPlan &p = plans_[half], &q = previous.plans_[half];
    const auto &s = p.field.settings, &t = q.field.settings;
    return context_.scene->same_light(*previous.context_.scene) && reflectance_ == previous.reflectance_ &&
           p.light_samples == q.light_samples && p.field.solver == q.field.solver && s.tolerance == t.tolerance &&
           s.relaxation == t.relaxation && p.field.counted == q.field.counted;
  }
  std::shared_ptr<const radiosity::FormFactors> reusable_factors(const RadiosityState& previous, uint32_t half) const {
    if (previous.is_refused_ || !previous.solutions_[half] || !has_same_factors(previous, half)) return nullptr;
    return previous.solutions_[half]->factors();
  }

  void prepare_lookup(uint32_t half) {
    const radiosity::IrradianceField& field = solutions_[half]->field();
    Lookup& lookup = lookups_[half];
    lookup.at_camera = integrator_.gather == RadiosityGather::none ? field.total : field.indirect;
    lookup.at_gather = field.gathered;
    if (vertices_.empty()) return;
    lookup.at_camera = vertices_.at_vertices(mesh(), lookup.at_camera);
    lookup.at_gather = vertices_.at_vertices(mesh(), lookup.at_gather);
  }

  template <class M>
  std::optional<uint64_t> sample_with(const PixelBlock& block, std::span<Rgb> radiance,
                                      const TaskContext& task_context) const {
    transport::PathWavefront<M>& paths = thread_wavefront<M>();
    const PixelOrder order(block);
    launch_camera_paths(context_, block, order, task_context, paths);
    estimate(lookups_[block.sample % film::kHalfBuffers], paths);
    return collect(paths, order, radiance);
  }

  template <class M>
  void estimate(const Lookup& lookup, transport::PathWavefront<M>& paths) const {
    using namespace transport;
    constexpr int kNoRoulette = 1000;
    const bool samples_light = integrator_.gather != RadiosityGather::none;
    const bool gathers = integrator_.gather == RadiosityGather::final_gathering;
    if (!paths.trace()) return;
    add_environment(paths);
    while (paths.next_hits()) {
      add_emission(paths);
      if (integrator_.at_max_depth(1)) continue;
      if (samples_light) add_direct_light(paths, LightStrategy::automatic, {});
      if (gathers)
        sample_bsdf(paths, kNoRoulette);
      else
        add_stored_light(paths, lookup.at_camera);
    }
    // Traces the shadow rays, and the gather rays if there are any.
    if (!paths.trace()) return;
    while (paths.next_hits()) add_stored_light(paths, lookup.at_gather);
  }

  // Adds the reflected light rho / pi H of the current hits.
  template <class M>
  void add_stored_light(transport::PathWavefront<M>& paths, const std::vector<Rgb>& irradiance) const {
    const Vec3 up(0, 0, 1);
    for (int i = 0; i < paths.hit_count(); ++i) {
      const scene::SurfacePoint& point = paths.point(i);
      const radiosity::PatchMesh::Location at = location_of(point);
      if (at.element == radiosity::kNoElement) continue;
      const Rgb h = vertices_.empty() ? irradiance[at.element] : vertices_.interpolate(irradiance, at);
      auto& path = paths.state_at(i);
      path.radiance += path.throughput * paths.bsdf(i).lobes.eval(up, up, TransportMode::radiance) * h;
    }
  }

  radiosity::PatchMesh::Location location_of(const scene::SurfacePoint& point) const {
    if (point.instance->round) return {};
    const Facet f = scene::facet_of(*point.instance, point.triangle, 0);
    const Vec3 e1 = f.p1 - f.p0, e2 = f.p2 - f.p0, d = point.position - f.p0;
    const float a = length_squared(e1), b = glm::dot(e1, e2), c = length_squared(e2);
    const float x = glm::dot(d, e1), y = glm::dot(d, e2), determinant = a * c - b * b;
    const uint32_t instance = point.instance->number;
    return mesh().locate(instance, point.triangle, (c * x - b * y) / determinant, (a * y - b * x) / determinant,
                         point.front);
  }

  const Radiosity& integrator_;
  const RenderContext context_;
  const bool is_refused_;
  radiosity::PatchMesh mesh_;                              // unless it is adaptive
  std::shared_ptr<radiosity::MeshRefinement> refinement_;  // of an adaptive mesh
  int first_round_ = 0;
  size_t rounds_ = 0;                  // of refinement, the first phases of the present sample
  std::vector<Rgb> reflectance_;       // by patch
  radiosity::PatchVertices vertices_;  // empty for constant reconstruction
  std::array<radiosity::SolutionPlan, film::kHalfBuffers> plans_;
  std::array<std::shared_ptr<radiosity::SceneSolution>, film::kHalfBuffers> solutions_;
  std::array<size_t, film::kHalfBuffers> first_stage_{};  // of the solution, which phase 0 of a sample runs
  std::array<Lookup, film::kHalfBuffers> lookups_;
};

}  // namespace

std::unique_ptr<RenderState> Radiosity::begin(const RenderContext& context, const RenderState* previous) const {
  return std::make_unique<RadiosityState>(*this, context, dynamic_cast<const RadiosityState*>(previous));
}

Registration radiosity_method() { return registration<Radiosity>(); }

}  // namespace etendue::integrator
