// Documents of consecutive states: equal to those that are opened one by one, without reading the scene again.
#include "render/state_opener.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "render/session.h"

namespace etendue::render {
namespace {

class StateOpenerTest : public testing::Test {
 protected:
  // The document of a state, after comparison with that of `document_from_state`.
  Document opened(const Document& document) {
    const std::string state = state_json(document, 0);
    auto opened = opener_.open(state, "test");
    EXPECT_TRUE(opened) << (opened ? "" : opened.error().message);
    if (!opened) return document;
    EXPECT_EQ(state_json(*opened, 0), state);
    EXPECT_EQ(state_json(*document_from_state(state, "test"), 0), state);
    return *opened;
  }

  StateOpener opener_;
};

TEST_F(StateOpenerTest, FollowsEdits) {
  const Document original = *new_document("cornell");
  Document document = original;
  opened(document);
  EXPECT_TRUE(opener_.is_reopened());
  const std::pair<const char*, Value> edits[] = {
      {"material.0.roughness", Value(0.3)},  {"material.0.roughness", Value(0.7)},
      {"camera.eye.x", Value(0.125)},        {"material.1.model", Value(std::string("conductor"))},
      {"material.1.roughness", Value(0.25)}, {"render.integrator", Value(std::string("bdpt"))},
      {"path.max-depth", Value(int64_t{4})}, {"environment.preset", Value(std::string("uniform"))},
      {"environment.tint.r", Value(0.5)},    {"node.1.translation.y", Value(0.1)},
      {"film.width", Value(int64_t{100})},
  };
  std::vector<Document> history{document};
  for (const auto& [name, value] : edits) {
    auto changed = with(document, name, value);
    if (!changed) continue;  // the scene has no such parameter
    document = *changed;
    history.push_back(document);
    opened(document);
    EXPECT_FALSE(opener_.is_reopened()) << name;
  }
  EXPECT_GE(history.size(), 10U);
  // Undo: settings have their original values again.
  while (!history.empty()) {
    opened(history.back());
    history.pop_back();
  }
  EXPECT_FALSE(opener_.is_reopened());
}

// Values of all kinds of parameters, at the ends of their ranges and between. Some edits are undone.
TEST_F(StateOpenerTest, FollowsRandomEdits) {
  std::mt19937 engine(7);
  const auto below = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(engine); };
  const auto value_of = [&](const ParameterInfo& info) -> Value {
    const double low = std::max(info.min, -10.0), high = std::min(info.max, 10.0);
    const double number = std::clamp(low + (high - low) * static_cast<double>(below(5)) / 4, info.min, info.max);
    switch (info.type) {
      case ParameterType::toggle:
        return below(2) == 0;
      case ParameterType::choice:
        return info.options[below(info.options.size())];
      case ParameterType::integer:
        return static_cast<int64_t>(number);
      case ParameterType::number:
        break;
    }
    return number;
  };
  Document document = *new_document("cornell");
  std::vector<Document> history{document};
  for (int i = 0; i < 250; ++i) {
    const auto names = sections(document);
    const auto parameters = section_parameters(document, names[below(names.size())]);
    if (parameters.empty()) continue;
    const ParameterInfo& info = parameters[below(parameters.size())].info;
    const auto changed = with(document, info.name, value_of(info));
    if (!changed || changed->automatic.enabled) continue;
    document = below(10) == 0 ? history[below(history.size())] : *changed;
    history.push_back(document);
    SCOPED_TRACE(info.name);
    opened(document);
  }
}

TEST_F(StateOpenerTest, HasTheSamplesOfTheDocument) {
  Document document = *new_document("cornell");
  document.width = 24;
  document.height = 16;
  opened(document);
  document = *with(document, "material.0.metallic", Value(1.0));
  document = *with(document, "node.1.translation.x", Value(0.05));
  const Document same = opened(document);
  const film::Film a = rendered(document, 4, 1), b = rendered(same, 4, 1);
  for (int y = 0; y < document.height; ++y)
    for (int x = 0; x < document.width; ++x) ASSERT_EQ(a.sum(x, y, 0), b.sum(x, y, 0)) << x << " " << y;
}

TEST_F(StateOpenerTest, SharesWhatIsEqual) {
  const Document document = *new_document("cornell");
  const Document first = opened(document);
  const Document second = opened(*with(document, "camera.eye.x", Value(0.1)));
  EXPECT_EQ(first.scene, second.scene);
}

TEST_F(StateOpenerTest, FollowsObjectsAndScenes) {
  Document document = *new_document("cornell");
  opened(document);
  document = *with_structural_edit(document, {.kind = scene::EditKind::duplicate, .node = 1, .name = "copy"});
  opened(document);
  document = *with_structural_edit(document, {.kind = scene::EditKind::add_light, .type = "point", .name = "lamp"});
  opened(document);
  const auto parameters = section_parameters(document, "light.0");
  ASSERT_FALSE(parameters.empty());
  for (const DocumentParameter& parameter : parameters)
    if (parameter.info.type == ParameterType::number)
      opened(*with(document, parameter.info.name, Value(0.5 * (parameter.info.min + 1))));
  EXPECT_FALSE(opener_.is_reopened());
  opened(*new_document("cornell-spheres"));
  EXPECT_TRUE(opener_.is_reopened());
  EXPECT_EQ(opener_.opened().scene_name, "cornell-spheres");
}

TEST_F(StateOpenerTest, DamagedStatesLeaveItUsable) {
  opened(*new_document("cornell"));
  EXPECT_FALSE(opener_.open("{", "test"));
  EXPECT_FALSE(opener_.open(R"({"program":"etendue","scene":"missing.glb","settings":{}})", "test"));
  opened(*new_document("cornell"));
}

}  // namespace
}  // namespace etendue::render
