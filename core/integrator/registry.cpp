// All integrators, in the order of [Lang].
#include <cassert>

#include "base/hash.h"
#include "film/half_buffers.h"
#include "integrator/registration.h"
#include "transport/path_expression/path_expression.h"

// clang-format off
#define ETENDUE_INTEGRATORS(ENTRY) \
  ENTRY(ray_casting)               \
  ENTRY(appel)                     \
  ENTRY(whitted)                   \
  ENTRY(distribution_ray_tracing)  \
  ENTRY(pure_path_tracing)         \
  ENTRY(path_tracing)              \
  ENTRY(guided_path_tracing)       \
  ENTRY(path_tracing_with_control)  \
  ENTRY(manifold_path_tracing)     \
  ENTRY(pure_light_tracing)        \
  ENTRY(light_tracing)             \
  ENTRY(bdpt)                      \
  ENTRY(guided_bdpt)               \
  ENTRY(vcm)                       \
  ENTRY(mlt)                       \
  ENTRY(pssmlt)                    \
  ENTRY(photon_mapping)            \
  ENTRY(progressive_photon_mapping)\
  ENTRY(instant_global_illumination)\
  ENTRY(radiosity_method)
// clang-format on

namespace etendue::integrator {

#define ETENDUE_DECLARE(NAME) Registration NAME();
ETENDUE_INTEGRATORS(ETENDUE_DECLARE)

namespace {

#define ETENDUE_CALL(NAME) NAME(),
const std::vector<Registration>& entries() {
  static const std::vector<Registration> all{ETENDUE_INTEGRATORS(ETENDUE_CALL)};
  return all;
}

}  // namespace

std::string_view bias_name(Bias bias) {
  return bias == Bias::unbiased ? "unbiased" : bias == Bias::consistent ? "consistent" : "biased";
}

std::string_view division_name(DivisionUnit unit) {
  constexpr std::array<std::string_view, 3> kNames{"samples", "passes", "none"};
  return kNames[static_cast<size_t>(unit)];
}

std::optional<uint64_t> RenderState::run(uint32_t, size_t, int, const TaskContext&) { return 0; }
std::optional<uint64_t> RenderState::sample(const PixelBlock&, std::span<Rgb>, const TaskContext&) { return 0; }

const std::vector<IntegratorInfo>& integrator_infos() {
  static const auto infos = [] {
    std::vector<IntegratorInfo> list;
    for (const auto& e : entries()) list.push_back(e.info);
    return list;
  }();
  return infos;
}

const IntegratorInfo* find_integrator(std::string_view name) {
  for (const auto& info : integrator_infos())
    if (info.name == name) return &info;
  return nullptr;
}

bool finds_any(std::string_view sampled, std::string_view paths) {
  if (paths.empty()) return true;
  const auto found = transport::PathExpression::parse(sampled),
             requested = transport::PathExpression::parse_paths(paths);
  assert(found && requested);
  // An intersection with too many states for an automaton counts as non-empty.
  const auto both = transport::Automaton::intersection(found->automaton(), requested->automaton());
  return !both || !both->empty();
}

std::unique_ptr<Integrator> make_integrator(std::string_view name, const std::vector<Setting>& settings) {
  for (const auto& e : entries()) {
    if (e.info.name != name) continue;
    auto integrator = e.make();
    for (const auto& s : settings) integrator->set(s.name, s.value);
    return integrator;
  }
  return nullptr;
}

RenderContext at_shared_time(RenderContext context, uint32_t sample) {
  if (!context.model->moving) return context;
  const uint32_t half = sample % film::kHalfBuffers, step = sample / film::kHalfBuffers;
  const auto shift = static_cast<uint32_t>(mix_bits(context.seed * film::kHalfBuffers + half));
  context.shared_time = to_unit_float(reverse_bits(step) + shift);
  return context;
}

}  // namespace etendue::integrator
