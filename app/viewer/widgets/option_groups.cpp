#include "viewer/widgets/option_groups.h"

#include <algorithm>

#include "bsdf/bsdf_model.h"
#include "integrator/integrator.h"

namespace etendue::viewer {
namespace {

ListedOption described(const ParameterInfo& info, size_t index) {
  const std::string& option = info.options[index];
  if (info.name.ends_with("integrator"))
    if (const auto* integrator = integrator::find_integrator(option)) {
      const auto& group = integrator::info_of(integrator->group);
      return {index, group.label, group.doc, integrator->summary.c_str()};
    }
  if (info.name.ends_with(".model"))
    if (const auto* model = find_bsdf_model(option)) {
      const auto kind = static_cast<size_t>(model->description.model_class);
      return {
          .index = index, .group = Options<ModelClass>::kOptions[kind].label, .tooltip = model->description.summary};
    }
  return {.index = index};
}

}  // namespace

std::vector<ListedOption> options_by_group(const ParameterInfo& info) {
  std::vector<ListedOption> list;
  for (size_t i = 0; i < info.options.size(); ++i) {
    const ListedOption option = described(info, i);
    const auto in_same_group = [&](const ListedOption& o) { return o.group == option.group; };
    const auto last = std::find_if(list.rbegin(), list.rend(), in_same_group);
    list.insert(option.group && last != list.rend() ? last.base() : list.end(), option);
  }
  return list;
}

}  // namespace etendue::viewer
