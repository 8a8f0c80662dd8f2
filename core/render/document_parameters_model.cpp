// Section "model": the flags of the transport model.
#include <algorithm>
#include <cctype>

#include "render/document_parameters.h"
#include "transport/model.h"

namespace etendue::render {

enum class FlagSetting { automatic, on };

}  // namespace etendue::render

template <>
struct etendue::Options<etendue::render::FlagSetting> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"auto", "Auto"}, {"on", "On"}}};
};

namespace etendue::render {

namespace {

std::string label_of(std::string flag) {
  if (flag == "classes") return "Path classes";
  flag.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(flag.front())));
  return flag;
}

}  // namespace

DocumentParameters model_parameters(const Document& document) {
  DocumentParameters list;
  for (const std::string& flag : transport::model_flags()) {
    const std::string label = label_of(flag);
    const bool on = std::ranges::find(document.forced_flags, flag) != document.forced_flags.end();
    DocumentParameter parameter = make_parameter(
        "model",
        Choice<FlagSetting>{flag.c_str(), label.c_str(), on ? FlagSetting::on : FlagSetting::automatic,
                            "Auto enables the feature only if the scene uses it; On forces it. The image is the same"},
        [](Document&, FlagSetting) {});
    parameter.assign = [flag](Document& d, const Value& v) {
      std::erase(d.forced_flags, flag);
      if (std::get<std::string>(v) == "on") d.forced_flags.push_back(flag);
      std::ranges::sort(d.forced_flags);
    };
    list.push_back(std::move(parameter));
  }
  return list;
}

}  // namespace etendue::render
