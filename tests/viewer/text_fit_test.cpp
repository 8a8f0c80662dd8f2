// Labels and the values of choices have room at the default width of the right column in a window of 1280x720. The texts
// are measured where they are drawn, with the fonts of the viewer.
#include <algorithm>
#include <set>

#include "integrator/integrator.h"
#include "light/light.h"
#include "render/document.h"
#include "sampling/sampler.h"
#include "scripted.h"

namespace etendue::text_fit_test {
namespace {

// "material.0.base-color.r" -> "material.0.base-color", the name of the widget.
std::string name_without_component(const std::string& name) {
  const size_t size = name.size();
  return size > 2 && name[size - 2] == '.' ? name.substr(0, size - 2) : name;
}

std::vector<std::string> options_of(const std::string& parameter) {
  const auto document = render::new_document("cornell");
  for (const auto& p : render::section_parameters(*document, parameter.substr(0, parameter.rfind('.'))))
    if (p.info.name == parameter) return p.info.options;
  return {};
}

class TextFit : public Viewer {
 protected:
  // A state of the viewer in which all parameters are drawn whose names begin with one of the prefixes.
  struct View {
    json steps;
    std::vector<std::string> prefixes;
  };

  void add(const json& steps, std::vector<std::string> prefixes) {
    views_.push_back({.steps = steps, .prefixes = std::move(prefixes)});
  }

  // All groups of a tab are open while a filter is set that all names contain.
  static json open_tab(const char* tab) { return json::array({click(tab), set("layout.filter", ".")}); }

  void expect_fit() {
    json steps = json::array({{{"do", "wait"}, {"spp", 1}}, set("film.width", 64), click("render.pause")});
    for (size_t i = 0; i < views_.size(); ++i) {
      steps = joined(steps, views_[i].steps);
      steps.push_back(file_step("state", path(file_of(i))));
    }
    ASSERT_EQ(run(steps, "cornell", 1280, 720), 0);
    for (size_t i = 0; i < views_.size(); ++i) expect_fit(views_[i], state(file_of(i)));
    EXPECT_GT(drawn_parameters_, views_.size());
  }

 private:
  static std::string file_of(size_t view) { return std::to_string(view) + ".json"; }

  void expect_fit(const View& view, const json& state) {
    const json& fit = state["texts_fit"];
    for (const auto& [name, fits] : fit.items()) EXPECT_TRUE(fits) << name << " after " << view.steps;
    for (const auto& [name, value] : state["parameters"].items()) {
      const auto is_prefix = [&](const std::string& prefix) { return name.starts_with(prefix); };
      if (std::ranges::none_of(view.prefixes, is_prefix) || name.find(".texture.") != std::string::npos) continue;
      ++drawn_parameters_;
      EXPECT_TRUE(fit.contains(name) || fit.contains(name_without_component(name)))
          << name << " is not drawn after " << view.steps;
    }
  }

  std::vector<View> views_;
  size_t drawn_parameters_ = 0;  // with the prefixes of their views
};

TEST_F(TextFit, Integrators) {
  add(open_tab("tab.render"), {"film.", "model."});
  for (const auto& info : integrator::integrator_infos())
    add(json::array({set("render.integrator", info.name)}), {"film.", info.name + "."});
  expect_fit();
}

TEST_F(TextFit, Samplers) {
  add(open_tab("tab.render"), {});
  for (const auto& info : sampler_infos())
    add(json::array({set("render.sampler", info.name)}), {"film.", info.name + "."});
  expect_fit();
}

TEST_F(TextFit, ReflectionModels) {
  const json select = json::array({set("material.0.model", "gltf")});
  add(joined(select, open_tab("tab.material")), {"material.0."});
  for (const std::string& model : options_of("material.0.model"))
    add(json::array({set("material.0.model", model)}), {"material.0.emission", "material.0." + model + "."});
  expect_fit();
}

TEST_F(TextFit, Media) {
  add(open_tab("tab.light"), {"atmosphere.", "environment."});
  for (const char* choice : {"atmosphere.medium", "atmosphere.phase-function", "atmosphere.density"})
    for (const std::string& option : options_of(choice)) add(json::array({set(choice, option)}), {"atmosphere."});
  expect_fit();
}

TEST_F(TextFit, Lights) {
  size_t index = 0;
  for (const auto& type : light_type_infos())
    add(joined(json::array({click(std::string("add.light.") + type.description.name)}), open_tab("tab.light")),
        {"light." + std::to_string(index++) + "."});
  expect_fit();
}

TEST_F(TextFit, OtherPanels) {
  add(open_tab("tab.camera"), {"camera.eye", "camera.lens", "camera.focus"});
  add(open_tab("tab.display"), {"display."});
  const json select = json::array({click("tab.scene"), set("layout.filter", ""), click("scene.node.0")});
  add(joined(select, open_tab("tab.scene")), {"node.0."});
  add(json::array({set("camera.projection", "orthographic")}), {});
  for (const char* panel : {"panel.convergence", "panel.techniques", "panel.sampling", "panel.trace", "panel.surface",
                            "panel.radiosity", "panel.sequence"})
    add(json::array({set("render.integrator", panel == std::string("panel.radiosity") ? "radiosity" : "bdpt"),
                     set("material.0.model", "lambert"),
                     click(panel),
                     {{"do", "wait"}, {"seconds", 0.1}}}),
        {});
  for (const char* experiment : {"sampling", "camera-response", "transport-operators", "random-walks"})
    add(json::array({set("lab.experiment", experiment)}), {});
  add(json::array({click("app.preferences"), {{"do", "wait"}, {"seconds", 0.2}}}), {});
  expect_fit();
}

}  // namespace
}  // namespace etendue::text_fit_test
