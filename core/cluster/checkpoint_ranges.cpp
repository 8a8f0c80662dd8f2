#include "cluster/checkpoint_ranges.h"

#include <nlohmann/json.hpp>

#include "base/json_text.h"

namespace etendue::cluster {
namespace {

using nlohmann::json;

constexpr const char* kRangesMember = "sample_ranges";

}  // namespace

std::string with_ranges(const std::string& state, const SampleRanges& ranges) {
  json j = json::parse(state);
  json list = json::array();
  for (const SampleRange& r : ranges.ranges()) list.push_back({r.first, r.end});
  j[kRangesMember] = list;
  return json_text(j);
}

SampleRanges ranges_of(const std::string& state, uint32_t samples) {
  SampleRanges ranges;
  const json j = json::parse(state, nullptr, false);
  if (!j.is_object() || !j.contains(kRangesMember)) {
    ranges.add({0, samples});
    return ranges;
  }
  for (const json& r : j[kRangesMember])
    if (r.is_array() && r.size() == 2 && r[0].is_number_unsigned() && r[1].is_number_unsigned())
      ranges.add({r[0].get<uint32_t>(), r[1].get<uint32_t>()});
  return ranges;
}

}  // namespace etendue::cluster
