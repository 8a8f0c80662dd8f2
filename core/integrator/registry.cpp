// Every integrator, in the order of the thesis; one line each.
#include <cassert>
#include <functional>

#include "base/hash.h"
#include "film/film.h"
#include "integrator/appel.h"
#include "integrator/bdpt.h"
#include "integrator/distribution.h"
#include "integrator/igi.h"
#include "integrator/light.h"
#include "integrator/light_pure.h"
#include "integrator/mlt.h"
#include "integrator/path.h"
#include "integrator/path_pure.h"
#include "integrator/photonmap.h"
#include "integrator/pssmlt.h"
#include "integrator/raycast.h"
#include "integrator/sppm.h"
#include "integrator/whitted.h"

namespace etendue::integrator {
namespace {

struct Entry {
  IntegratorInfo info;
  std::function<std::unique_ptr<Integrator>()> make;
};

template <class T>
Entry entry() {
  const Description& d = T::kDescription;
  IntegratorInfo info{d.name,     d.label, d.doc,   d.group, d.paths,      d.point_paths,   d.bias,
                      d.sampling, d.cost,  d.fails, d.key,   d.techniques, T().parameters()};
  return {std::move(info), [] { return std::make_unique<T>(); }};
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      entry<Raycast>(),
      entry<Appel>(),
      entry<Whitted>(),
      entry<Distribution>(),
      entry<PathPure>(),
      entry<Path>(),
      entry<LightPure>(),
      entry<Light>(),
      entry<Bdpt>(),
      entry<Mlt>(),
      entry<Pssmlt>(),
      entry<PhotonMapping>(),
      entry<ProgressivePhotonMapping>(),
      entry<InstantGlobalIllumination>(),
  };
  return all;
}

}  // namespace

std::string_view bias_name(Bias bias) {
  return bias == Bias::unbiased ? "unbiased" : bias == Bias::consistent ? "consistent" : "biased";
}

std::optional<uint64_t> Work::run(uint32_t, size_t, int, const Turn&) { return 0; }
std::optional<uint64_t> Work::sample(const PixelBlock&, std::span<Rgb>, const Turn&) { return 0; }

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

bool finds_any(const IntegratorInfo& info, std::string_view paths) {
  if (paths.empty()) return true;
  const auto found = transport::PathExpression::parse(info.paths),
             asked = transport::PathExpression::parse_paths(paths);
  assert(found && asked);
  // Too many states for an automaton are not nothing.
  const auto both = transport::Automaton::intersection(found->automaton(), asked->automaton());
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

Pass at_one_moment(Pass pass, uint32_t sample) {
  if (!pass.model->moving) return pass;
  const uint32_t half = sample % film::kReplicates, step = sample / film::kReplicates;
  const auto shift = static_cast<uint32_t>(mix_bits(pass.seed * film::kReplicates + half));
  pass.moment = to_unit_float(reverse_bits(step) + shift);
  return pass;
}

}  // namespace etendue::integrator
