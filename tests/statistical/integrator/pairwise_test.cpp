// All methods without bias agree with each other, in pairs, on paths that both find: the registry says which methods
// these are, each of its own accord which paths it finds, and each choice and switch that it has is turned once.
//
// Every form of a method that finds a class of paths whole renders it once, with seeds of its own, and each pair is
// compared block by block: z-tests, 1 % false alarms for the family, which is all blocks of all pairs of a test.
#include <gtest/gtest.h>

#include "advisor/declared_paths.h"
#include "integrator/integrator.h"
#include "support/media_scenes.h"
#include "support/motion.h"
#include "support/integrator_scenes.h"

namespace etendue {
namespace {

using integrator::IntegratorInfo;
using render::Document;

// Chains have none either once their starts are chosen among enough candidates (thesis, Remark 9.19).
bool without_bias(const IntegratorInfo& info) {
  return info.bias == integrator::Bias::unbiased || info.group == integrator::Group::markov_chain;
}

// How many samples a form takes for one of the others: those that are noisy for their time have more, so that their
// block means are normally distributed too.
double effort(std::string_view form) {
  struct Effort {
    std::string_view form;
    double samples;
  };
  for (const Effort& e : {Effort{"path-pure", 4}, Effort{"light-pure", 16}, Effort{"light", 4},
                          Effort{"bdpt:reuse=false", 8}, Effort{"pssmlt:form=multiplexed", 32}, Effort{"mlt", 2}})
    if (form.starts_with(e.form)) return e.samples;
  return 1;
}

struct Form {
  std::string name;
  Document document;
};

// The values that a choice or a switch has besides its default.
std::vector<std::string> other_values(const ParameterInfo& parameter) {
  std::vector<std::string> values;
  if (parameter.type == ParameterType::toggle) values = {"true", "false"};
  if (parameter.type == ParameterType::choice && !parameter.validate_text) values = parameter.options;
  std::erase(values, to_string(parameter.default_value));
  return values;
}

// A method as it is, and with each of its choices and switches turned.
std::vector<Form> forms_of(const IntegratorInfo& info, const Document& place) {
  Document d = test::with_integrator(place, info.name);
  // A few chains that go far, rather than many that hardly leave their starts.
  if (info.group == integrator::Group::markov_chain) d = test::with(d, "chains", "32");
  std::vector<Form> forms{{info.name, d}};
  for (const ParameterInfo& parameter : info.parameters)
    for (const std::string& value : other_values(parameter))
      if (parameter.name != info.techniques.weighted)
        forms.push_back({info.name + ':' + parameter.name + '=' + value, test::with(d, parameter.name.c_str(), value)});
  return forms;
}

bool finds_all(const Document& d, const scene::CompiledScene& scene) {
  return advisor::without(advisor::requested_paths(d), advisor::declared_paths(d, scene).paths).empty();
}

// The forms of all methods that find every path of the class.
std::vector<Form> finders(const Document& place, const std::string& paths, const std::vector<std::string>& but) {
  const auto scene = scene::compile(place.scene, place.camera, nullptr);
  std::vector<Form> found;
  for (const IntegratorInfo& info : integrator::integrator_infos()) {
    if (!without_bias(info)) continue;
    for (Form& form : forms_of(info, place)) {
      form.document.method.paths = paths;
      if (std::ranges::count(but, form.name) == 0 && finds_all(form.document, *scene)) found.push_back(std::move(form));
    }
  }
  return found;
}

// `but`: forms that this is no place for.
void expect_pairs_agree(const Document& place, const std::string& paths, uint32_t samples,
                        const std::vector<std::string>& but = {}) {
  struct Answer {
    std::string name;
    test::Estimate estimate;
  };
  std::vector<Answer> answers;
  for (const Form& form : finders(place, paths, but)) {
    const auto own = static_cast<uint32_t>(samples * effort(form.name));
    answers.push_back({form.name, test::replicated(form.document, own, 1000 * (answers.size() + 2))});
  }
  const auto n = static_cast<int>(answers.size());
  EXPECT_GE(n, 17);  // of seven methods at least
  for (size_t i = 0; i < answers.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      test::expect_agreement(answers[i].estimate, answers[j].estimate, answers[i].name + " and " + answers[j].name,
                             n * (n - 1) / 2);
}

Document builtin(const char* name) {
  Document d = *render::new_document(name);
  d.width = d.height = test::kSize;
  return d;
}

TEST(Pairwise, Cornell) { expect_pairs_agree(builtin("cornell"), "E(D|G)*L", 48); }
TEST(Pairwise, DirectLightOfCornell) { expect_pairs_agree(builtin("cornell"), "E(D|G)L", 64); }

TEST(Pairwise, GlossyPlates) { expect_pairs_agree(builtin("glossy-plates"), "E(D|G)*L", 64); }

// Metal, glass rough and smooth, a sheet, glaze: every lobe.
TEST(Pairwise, GlossyThings) { expect_pairs_agree(test::glossy_scene(), "E[(D|G).*]L", 64); }
TEST(Pairwise, GlossyThingsInMirrors) { expect_pairs_agree(test::glossy_scene(), "ES.*L", 64); }

// Not reciprocal, brushed, rough, tabulated, coated: both ways through every kind of lobe.
TEST(Pairwise, ModelledThings) { expect_pairs_agree(test::bsdf_model_scene(), "E[(D|G).*]L", 64); }

TEST(Pairwise, UnderALamp) { expect_pairs_agree(test::balls_under_area_light(), "E[(D|G).*]L", 64); }
TEST(Pairwise, GlassBallUnderALamp) { expect_pairs_agree(test::balls_under_area_light(), "ES.*L", 64); }

// A quad, a disk and a sphere, whose points each method finds in its own way.
TEST(Pairwise, UnderSurfaceLights) { expect_pairs_agree(test::balls_under_analytic_lights(), "E[(D|G).*]L", 64); }

TEST(Pairwise, UnderASky) { expect_pairs_agree(test::balls_under_sky(), "E[(D|G).*]L", 64); }
// Long paths through the ball are tried in the multiplexed form by one technique at a time, of which one finds them:
// once in a million samples, which then count as much as all others. Twelve pictures have no normal distribution then.
const std::vector<std::string> kRareThroughGlass{"pssmlt:form=multiplexed"};
TEST(Pairwise, GlassBallUnderASky) { expect_pairs_agree(test::balls_under_sky(), "ES.*L", 64, kRareThroughGlass); }

// On a lens of 15 cm one walk in some thousands ends.
TEST(Pairwise, LensAndShutter) { expect_pairs_agree(test::motion_and_lens_scene(), "E(D|G)*L", 64, {"light-pure"}); }
TEST(Pairwise, DirectLightThroughLensAndShutter) {
  expect_pairs_agree(test::motion_and_lens_scene(), "E(D|G)L", 64, {"light-pure"});
}

TEST(Pairwise, WideLens) {
  const Document d =
      test::with(test::with(builtin("cornell"), "camera.lens-radius", "1.5"), "camera.focus-distance", "8");
  expect_pairs_agree(d, "E(D|G)*L", 48);
}
TEST(Pairwise, WideLensAndShutter) {
  expect_pairs_agree(test::with(test::motion_and_lens_scene(), "camera.lens-radius", "0.8"), "E(D|G)*L", 64);
}

// The floor of a pool, lit and seen through water alone. Only chance finds these paths, so that the lamp is large.
TEST(Pairwise, CausticBehindGlass) {
  Document d = builtin("caustic-pool");
  scene::Scene pool = *d.scene;
  for (scene::Node& node : pool.nodes) {
    if (node.name == "fill light") node.visible = true;
    if (node.name == "light") node.visible = false;
  }
  d.scene = std::make_shared<const scene::Scene>(std::move(pool));
  expect_pairs_agree(d, "ES+DS+L", 40);
}

// ---- Nested solids.

TEST(Pairwise, StoneInTintedWater) {
  expect_pairs_agree(test::stone_in_tinted_water(), "ES.*L", 64, kRareThroughGlass);
}
TEST(Pairwise, IceInWaterTouchesGlass) {
  expect_pairs_agree(test::ice_in_water_in_glass(false), "ES.*L", 64, kRareThroughGlass);
}
TEST(Pairwise, IceInWaterOverlapsGlass) {
  expect_pairs_agree(test::ice_in_water_in_glass(true), "ES.*L", 64, kRareThroughGlass);
}
TEST(Pairwise, BesideIceInWaterInGlass) {
  expect_pairs_agree(test::ice_in_water_in_glass(true), "E[(D|G).*]L", 64, kRareThroughGlass);
}
TEST(Pairwise, Bubble) { expect_pairs_agree(test::bubble(), "ES.*L", 64, kRareThroughGlass); }
TEST(Pairwise, LampInTintedWater) {
  expect_pairs_agree(test::light_in_tinted_water(false), "ES.*L", 64, kRareThroughGlass);
}
TEST(Pairwise, LampAndCameraInTintedWater) {
  expect_pairs_agree(test::light_in_tinted_water(true), "E[(D|G).*]L", 64, kRareThroughGlass);
}
TEST(Pairwise, CameraInsideGlass) {
  expect_pairs_agree(test::camera_inside_glass(), "E[(D|G).*]L", 64, kRareThroughGlass);
}

}  // namespace
}  // namespace etendue
