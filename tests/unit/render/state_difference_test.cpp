// Differences between the settings of images, found without opening their scenes.
#include "render/state_difference.h"

#include <gtest/gtest.h>

#include <map>

#include "render/document.h"

namespace etendue::render {
namespace {

Document cornell() {
  auto document = new_document("cornell");
  EXPECT_TRUE(document);
  return *document;
}

std::map<std::string, std::pair<std::string, std::string>> differences(const Document& a, const Document& b) {
  std::map<std::string, std::pair<std::string, std::string>> found;
  const auto list = differences_of_states(state_json(a, 1), state_json(b, 2));
  EXPECT_TRUE(list) << list.error().message;
  for (const SettingDifference& d : *list) found[d.name] = {d.a, d.b};
  return found;
}

TEST(StateDifference, NamesTheSettingsThatDiffer) {
  const Document a = cornell();
  EXPECT_TRUE(differences(a, a).empty()) << "the number of samples is not a setting";
  auto b = with(a, "render.integrator", Value(std::string("bdpt")));
  b = with(*b, "material.5.roughness", Value(0.25));
  const auto found = differences(a, *b);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found.at("render.integrator"), std::pair(std::string(), std::string("bdpt")));
  EXPECT_EQ(found.at("material.5.roughness"), std::pair(std::string(), std::string("0.25")));
  EXPECT_EQ(differences(*b, a).at("material.5.roughness").first, "0.25");
}

TEST(StateDifference, ScenesAndStructureAreCompared) {
  const Document a = cornell(), b = *new_document("cornell-spheres");
  EXPECT_EQ(differences(a, b).at("scene"), std::pair(std::string("cornell"), std::string("cornell-spheres")));
  const auto with_box = with_structural_edit(a, {.kind = scene::EditKind::add_shape, .type = "box", .name = "box"});
  const auto with_disk = with_structural_edit(a, {.kind = scene::EditKind::add_shape, .type = "disk", .name = "box"});
  ASSERT_TRUE(with_box && with_disk);
  EXPECT_EQ(differences(a, *with_box).at("structure").second, "1 edit");
  const auto other_kind = differences(*with_box, *with_disk).at("structure");
  EXPECT_NE(other_kind.first, other_kind.second);
}

TEST(StateDifference, OnlyTheSamplesMayDiffer) {
  const Document a = cornell();
  EXPECT_TRUE(same_settings(state_json(a, 1), state_json(a, 64)));
  EXPECT_FALSE(same_settings(state_json(a, 1), state_json(*with(a, "render.seed", Value(int64_t{3})), 1)));
  EXPECT_EQ(samples_of_state(state_json(a, 64)), 64U);
}

TEST(StateDifference, OtherTextsAreNotStates) {
  const std::string state = state_json(cornell(), 1);
  for (const char* text : {"", "{", "[]", "null", "{\"settings\": 3}", "{\"settings\": []}"}) {
    EXPECT_FALSE(differences_of_states(state, text)) << text;
    EXPECT_FALSE(same_settings(text, text)) << text;
    EXPECT_EQ(samples_of_state(text), 0U) << text;
  }
  EXPECT_EQ(samples_of_state("{\"settings\": {}, \"samples\": -4}"), 0U);
  EXPECT_EQ(samples_of_state("{\"settings\": {}, \"samples\": \"many\"}"), 0U);
}

}  // namespace
}  // namespace etendue::render
