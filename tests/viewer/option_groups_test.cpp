// Lists of integrators and reflection models: groups stay together.
#include "viewer/widgets/option_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "bsdf/bsdf_model.h"
#include "integrator/integrator.h"
#include "render/document.h"

namespace etendue::viewer {
namespace {

ParameterInfo parameter(const std::string& section, const std::string& name) {
  const auto document = render::new_document("cornell");
  for (const auto& p : render::section_parameters(*document, section))
    if (p.info.name == name) return p.info;
  ADD_FAILURE() << name;
  return {};
}

// Each option once, each group in one piece, and the order within a group as it was.
void expect_groups(const ParameterInfo& info, size_t least_groups) {
  const auto listed = options_by_group(info);
  ASSERT_EQ(listed.size(), info.options.size());
  std::set<size_t> indices;
  std::set<std::string> ended;
  std::string group;
  size_t last = 0;
  for (const ListedOption& option : listed) {
    EXPECT_TRUE(indices.insert(option.index).second);
    const std::string own = option.group ? option.group : "";
    if (own != group) {
      EXPECT_TRUE(own.empty() || !ended.contains(own)) << own << " is in two pieces";
      ended.insert(group);
      group = own;
    } else if (!own.empty()) {
      EXPECT_GT(option.index, last);
    }
    last = option.index;
  }
  EXPECT_GE(ended.size() + 1, least_groups);
}

TEST(OptionGroups, ReflectionModels) {
  const ParameterInfo info = parameter("material.0", "material.0.model");
  expect_groups(info, 4);
  for (const ListedOption& option : options_by_group(info))
    if (const auto* model = find_bsdf_model(info.options[option.index])) {
      const auto kind = static_cast<size_t>(model->description.model_class);
      EXPECT_STREQ(option.group, Options<ModelClass>::kOptions[kind].label);
    }
}

TEST(OptionGroups, Integrators) { expect_groups(parameter("render", "render.integrator"), 3); }

TEST(OptionGroups, OtherChoicesHaveNone) {
  const ParameterInfo info = parameter("render", "render.sampler");
  const auto listed = options_by_group(info);
  ASSERT_EQ(listed.size(), info.options.size());
  for (size_t i = 0; i < listed.size(); ++i) {
    EXPECT_EQ(listed[i].index, i);
    EXPECT_EQ(listed[i].group, nullptr);
  }
}

}  // namespace
}  // namespace etendue::viewer
