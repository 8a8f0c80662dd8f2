// Integrators: shortcuts, incompatibilities, missing paths, statistics, stored photons and techniques.
#include <algorithm>
#include <set>

#include "integrator/integrator.h"
#include "render/document.h"
#include "scripted.h"
#include "viewer/state/document_info.h"
#include "viewer/tasks/technique_task.h"

namespace etendue::integrators_test {
namespace {

json steps_of(std::initializer_list<json> steps) { return json::array_t(steps); }

class Integrators : public Viewer {
 protected:
  // Expects that the last step of the script fails with this message.
  void expect_refusal(const json& steps, const std::string& words) {
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(run(steps), 1);
    const auto text = ::testing::internal::GetCapturedStderr();
    EXPECT_NE(text.find(words), std::string::npos) << text;
  }
};

TEST_F(Integrators, EachShortcutSelectsItsIntegrator) {
  json steps = small(1);
  std::vector<std::string> names;
  for (const auto& info : integrator::integrator_infos()) {
    if (!info.shortcut) continue;
    names.push_back(info.name);
    steps.push_back(key(std::string(1, info.shortcut)));
    steps.push_back(file_step("state", path(info.name + ".json")));
  }
  ASSERT_EQ(run(steps), 0);
  for (const auto& name : names) EXPECT_EQ(state(name + ".json")["parameters"]["render.integrator"], name);
}

TEST_F(Integrators, ShortcutsAreUnique) {
  std::set<std::string> keys;
  for (const auto& entry : json::parse(viewer::widgets_json())) {
    if (!entry.contains("shortcut")) continue;
    for (const auto& shortcut : entry["shortcut"])
      EXPECT_TRUE(keys.insert(shortcut.get<std::string>()).second) << entry["name"] << ' ' << shortcut;
  }
}

TEST_F(Integrators, IncompatibilityIsReportedUntilItIsResolved) {
  const auto steps = joined(small(), steps_of({set("render.integrator", "light-pure"),
                                               {{"do", "wait"}, {"spp", 1}},
                                               file_step("state", path("a.json")),
                                               file_step("screenshot", path("a.png")),
                                               set("camera.lens-radius", 0.1),
                                               {{"do", "wait"}, {"spp", 1}},
                                               file_step("state", path("b.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_NE(state("a.json")["obstacle"].get<std::string>().find("camera.lens-radius"), std::string::npos);
  EXPECT_EQ(state("b.json")["obstacle"], "");
}

TEST_F(Integrators, AdaptiveSamplingIsRefusedIfItHasNoEffect) {
  expect_refusal(joined(small(), steps_of({set("render.integrator", "light"), set("render.adaptive", "rmse")})),
                 "does not sample pixel by pixel");
}

TEST_F(Integrators, WaitForPixelFailsIfTheIntegratorHasNoPixelSamples) {
  expect_refusal(joined(small(), steps_of({set("render.integrator", "light"), click("panel.sampling"),
                                           click("sampling.pick"), wait_for("pixel")})),
                 "no sample of this integrator belongs to one pixel");
}

TEST_F(Integrators, MissingPathsAreMeasuredAutomatically) {
  const auto steps = joined(
      small(), steps_of({set("render.integrator", "raycast"), wait_for("misses"), file_step("state", path("a.json")),
                         set("render.integrator", "path"), wait_for("misses"), file_step("state", path("b.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_GT(state("a.json")["misses"].get<double>(), 0.05);
  EXPECT_EQ(state("b.json")["misses"], 0);
  // The table of path classes was not measured.
  EXPECT_TRUE(state("a.json")["paths"]["rows"].empty());
}

// The first image is rendered with the present integrator. The choice is one step of undo and is not repeated after it.
TEST_F(Integrators, AutomaticChoosesAnIntegratorAndSaysSo) {
  const auto steps = joined(small(), steps_of({click("tab.render"),
                                               set("render.integrator", "auto"),
                                               file_step("state", path("a.json")),
                                               wait_for("automatic"),
                                               file_step("state", path("b.json")),
                                               file_step("screenshot", path("b.png")),
                                               key("ctrl+z"),
                                               {{"do", "wait"}, {"spp", 1}},
                                               file_step("state", path("c.json")),
                                               set("render.integrator", "path"),
                                               file_step("state", path("d.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_EQ(state("a.json")["automatic"]["reason"], "");
  EXPECT_EQ(state("a.json")["automatic"]["integrator"], "path");
  const json chosen = state("b.json");
  EXPECT_EQ(chosen["parameters"]["render.integrator"], "auto");
  const std::string integrator = chosen["automatic"]["integrator"], reason = chosen["automatic"]["reason"];
  EXPECT_NE(integrator::find_integrator(integrator), nullptr) << integrator;
  EXPECT_FALSE(reason.empty());
  EXPECT_NE(chosen["undo"].dump().find("Automatic integrator"), std::string::npos) << chosen["undo"];
  EXPECT_EQ(state("c.json")["automatic"]["reason"], "");
  EXPECT_TRUE(state("d.json")["automatic"].is_null());
}

TEST_F(Integrators, AutomaticCanBeRepeated) {
  const auto steps = joined(
      small(), steps_of({click("tab.render"), set("render.integrator", "auto"), set("auto.allow", "consistent"),
                         wait_for("automatic"), click("integrator.choose-again"), file_step("state", path("a.json")),
                         wait_for("automatic"), file_step("state", path("b.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_EQ(state("a.json")["automatic"]["reason"], "");
  EXPECT_NE(state("b.json")["automatic"]["reason"], "");
}

TEST_F(Integrators, DisabledTechniquesAreEditedAsTextAndUndone) {
  const auto steps = joined(small(), steps_of({set("render.integrator", "bdpt"), set("bdpt.without", "0,*"),
                                               file_step("state", path("a.json")), key("ctrl+z"),
                                               file_step("state", path("b.json")), click("bdpt.without"), key("1"),
                                               key(","), key("2"), key("enter"), file_step("state", path("c.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_EQ(state("a.json")["parameters"]["bdpt.without"], "0,*");
  EXPECT_EQ(state("b.json")["parameters"]["bdpt.without"], "");
  EXPECT_EQ(state("c.json")["parameters"]["bdpt.without"], "1,2");
  expect_refusal(joined(small(), steps_of({set("render.integrator", "bdpt"), set("bdpt.without", "0;1")})),
                 "is not a technique");
}

TEST_F(Integrators, StatisticsOfTheIntegratorAreReported) {
  const auto& infos = integrator::integrator_infos();
  const auto chains = std::ranges::find(infos, integrator::Group::markov_chain, &integrator::IntegratorInfo::group);
  ASSERT_NE(chains, infos.end());
  const auto steps = joined(small(2), steps_of({file_step("state", path("a.json")),
                                                set("render.integrator", chains->name),
                                                {{"do", "wait"}, {"spp", 2}},
                                                file_step("state", path("b.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_TRUE(state("a.json")["statistics"].empty());
  EXPECT_FALSE(state("b.json")["statistics"].empty());
}

TEST_F(Integrators, PhotonsAreDrawnAtTheirPositions) {
  const auto steps = joined(small(2), steps_of({set("render.integrator", "photonmap"),
                                                {{"do", "wait"}, {"spp", 2}},
                                                file_step("screenshot", path("without.png")),
                                                click("view.points"),
                                                wait_for("points"),
                                                file_step("state", path("a.json")),
                                                file_step("screenshot", path("with.png")),
                                                set("render.integrator", "path"),
                                                {{"do", "wait"}, {"spp", 2}},
                                                wait_for("points"),
                                                file_step("state", path("b.json"))}));
  ASSERT_EQ(run(steps), 0);
  const auto points = state("a.json")["points"];
  EXPECT_GT(points["kept"], 100);
  EXPECT_GT(points["seen"], 10);
  EXPECT_LE(points["seen"], points["kept"]);
  EXPECT_EQ(state("b.json")["points"]["kept"], 0);
  const auto with = image::read_linear(path("with.png")), without = image::read_linear(path("without.png"));
  ASSERT_TRUE(with && without);
  EXPECT_NE(with->find("")->pixels, without->find("")->pixels);
}

class Techniques : public Viewer {
 protected:
  static json pyramid(bool weighted) {
    return joined(small(1), steps_of({set("render.integrator", "bdpt"), click("panel.techniques"),
                                      set("techniques.samples", 8), set("techniques.longest", 3),
                                      set("techniques.weighted", weighted), wait_for("techniques")}));
  }
  static double mean_of(const json& state, int s, int t) {
    for (const auto& cell : state["techniques"]["cells"])
      if (cell["s"] == s && cell["t"] == t) return cell["mean"];
    return -1;
  }
};

TEST_F(Techniques, ImagesAddUpToTheImageOfTheIntegrator) {
  auto steps = joined(pyramid(true),
                      steps_of({set("bdpt.max-depth", 3), wait_for("techniques"), file_step("state", path("a.json")),
                                file_step("screenshot", path("a.png")), set("techniques.weighted", false),
                                wait_for("techniques"), file_step("state", path("b.json"))}));
  ASSERT_EQ(run(steps), 0);
  const auto a = state("a.json"), b = state("b.json");
  ASSERT_EQ(a["techniques"]["cells"].size(), 12u);
  double sum = 0;
  for (const auto& cell : a["techniques"]["cells"]) sum += cell["mean"].get<double>();
  // The same random numbers give the same paths.
  EXPECT_NEAR(sum, a["techniques"]["mean"].get<double>(), 1e-3 * sum);
  EXPECT_NEAR(a["techniques"]["sum"]["share"].get<double>(), 1, 1e-3);
  double variance = 0;
  for (const auto& cell : a["techniques"]["cells"])
    if (cell.contains("share"))
      variance += std::pow(cell["standard_error"].get<double>() / a["techniques"]["mean"].get<double>(), 2);
  EXPECT_GT(a["techniques"]["sum"]["error"].get<double>(), std::sqrt(variance));
  EXPECT_LT(a["techniques"]["sum"]["error"].get<double>(), 0.5);
  // Without MIS weights, each technique estimates the whole image.
  for (const auto& [s, t] : {std::pair(0, 3), {1, 2}, {2, 1}}) EXPECT_GT(mean_of(b, s, t), mean_of(a, s, t)) << s << t;
  // No light path can hit a pinhole.
  EXPECT_EQ(mean_of(a, 3, 0), 0);
}

TEST_F(Techniques, ClickDisablesATechniqueAndAnotherEnablesIt) {
  const auto steps = joined(
      pyramid(true),
      steps_of({file_step("state", path("a.json")), click("techniques.cell.1.2"), file_step("state", path("off.json")),
                wait_for("techniques"), file_step("state", path("without.json")), click("techniques.cell.1.2"),
                file_step("state", path("back.json")), key("ctrl+z"), click("techniques.all"),
                file_step("state", path("all.json"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_EQ(state("off.json")["parameters"]["bdpt.without"], "1,2");
  EXPECT_EQ(state("back.json")["parameters"]["bdpt.without"], "");
  EXPECT_EQ(state("all.json")["parameters"]["bdpt.without"], "");
  // The other techniques have its weight.
  EXPECT_EQ(mean_of(state("without.json"), 1, 2), 0);
  EXPECT_GT(mean_of(state("without.json"), 0, 3), mean_of(state("a.json"), 0, 3));
}

TEST_F(Techniques, ExportAsLayersAndAsAGrid) {
  const auto steps = joined(
      pyramid(true), steps_of({click("techniques.export"), set("files.name", path("t.exr")), click("files.accept"),
                               wait_for("techniques"), click("techniques.export"), set("files.name", path("t.png")),
                               click("files.accept"), wait_for("techniques")}));
  ASSERT_EQ(run(steps), 0);
  const auto layers = saved_image("t.exr");
  EXPECT_TRUE(layers.find("technique.1.2"));
  EXPECT_TRUE(layers.find(""));
  EXPECT_FALSE(layers.find("technique.3.0"));
  const auto grid = image::read_linear(path("t.png"));
  ASSERT_TRUE(grid) << grid.error().message;
  EXPECT_EQ(grid->width, 5 * (layers.width + 4) - 4);
}

TEST(TechniqueSet, AddAndRemove) {
  using viewer::toggle_technique;
  EXPECT_EQ(toggle_technique("", 1, 2), "1,2");
  EXPECT_EQ(toggle_technique("0,3", 1, 2), "0,3 1,2");
  EXPECT_EQ(toggle_technique("0,3 1,2", 1, 2), "0,3");
  EXPECT_EQ(toggle_technique("1,* 0,3", 1, 2), "0,3");
}

// Messages name parameters as the panels do, also those of an integrator, and of another one than the document's.
TEST(LabelledMessages, NameTheParametersOfTheIntegrator) {
  const render::Document d = *render::new_document("cornell");
  const auto message =
      viewer::with_labels(d, "radiosity: the surface is not diffuse; set radiosity.surfaces to approximate");
  EXPECT_EQ(message.text.find("radiosity."), std::string::npos) << message.text;
  EXPECT_TRUE(message.text.starts_with("Radiosity: ")) << message.text;
  EXPECT_TRUE(message.parameters.empty()) << "the document has no such parameter";
  const auto chosen = *render::with_text(d, "render.integrator", "radiosity");
  EXPECT_EQ(viewer::with_labels(chosen, "radiosity: set radiosity.surfaces").parameters,
            std::vector<std::string>{"radiosity.surfaces"});
}

}  // namespace
}  // namespace etendue::integrators_test
