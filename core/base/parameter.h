// Parameters that describe themselves.
//
// A knob is declared once, as a member of the thing that it turns:
//
//   Number<int> roulette_start{"roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths"};
//
// and the thing lists its knobs in one place (`auto parameters() { return std::tie(roulette_start, ...); }`). Widgets,
// `--set`, `list --json`, snapshots and undo all read the type-erased description that `describe` makes of it.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace etendue {

using Value = std::variant<bool, int64_t, double, std::string>;

enum class ParameterType { toggle, integer, number, choice };

struct ParameterInfo {
  std::string name, label, unit, doc;
  ParameterType type = ParameterType::number;
  double min = 0, max = 0;                          // inclusive; integers and numbers only
  bool logarithmic = false;                         // the quantity is naturally seen on a logarithmic slider
  Value default_value = false;                      // a choice's value is the name of the option
  std::vector<std::string> options, option_labels;  // choices only
  // A choice with this also takes a text that is none of its options, if it passes; else the error says why not.
  Result<void> (*validate_text)(std::string_view) = nullptr;
};

std::string to_string(const Value& value);
std::string_view type_name(ParameterType type);

// Reads `text` as a value of this parameter: true/false/on/off, a number within the range, the name of an option.
Result<Value> parse_value(const ParameterInfo& info, std::string_view text);

// The value, if it has the right type and lies in the range (an integer is accepted where a number is wanted).
Result<Value> checked_value(const ParameterInfo& info, const Value& value);

template <class T>
struct Range {
  T min, max;
};

enum class Scale { linear, logarithmic };

template <class T>
struct Number {
  static_assert(std::is_same_v<T, int> || std::is_same_v<T, float>);
  const char* name;
  const char* label;
  T value;
  Range<T> range;
  const char* doc;
  const char* unit = "";
  Scale scale = Scale::linear;

  operator T() const { return value; }  // NOLINT(google-explicit-constructor)
};

// Three numbers that belong together: NAME.r, NAME.g and NAME.b.
struct Triple {
  static constexpr const char* kParts[3] = {".r", ".g", ".b"};

  const char* name;
  const char* label;
  Vec3 value;
  Range<float> range;
  const char* doc;
  const char* unit = "";
  Scale scale = Scale::linear;
};

struct Toggle {
  const char* name;
  const char* label;
  bool value;
  const char* doc;

  operator bool() const { return value; }  // NOLINT(google-explicit-constructor)
};

// Specialise with `static constexpr std::array<Option, N> kOptions` in the order of the enumerators.
struct Option {
  const char* name;
  const char* label;
};
template <class E>
struct Options;

template <class E>
struct Choice {
  const char* name;
  const char* label;
  E value;
  const char* doc;

  operator E() const { return value; }  // NOLINT(google-explicit-constructor)
};

// A text that has to pass `accepts`; the first of `offered` is what it is at first.
struct Text {
  const char* name;
  const char* label;
  std::string value;
  const char* doc;
  Result<void> (*accepts)(std::string_view);
  std::vector<Option> offered;

  operator const std::string&() const { return value; }  // NOLINT(google-explicit-constructor)
};

template <class T>
ParameterInfo describe(const Number<T>& p) {
  ParameterInfo info;
  info.name = p.name, info.label = p.label, info.unit = p.unit, info.doc = p.doc;
  info.type = std::is_same_v<T, int> ? ParameterType::integer : ParameterType::number;
  info.min = static_cast<double>(p.range.min), info.max = static_cast<double>(p.range.max);
  info.logarithmic = p.scale == Scale::logarithmic;
  if constexpr (std::is_same_v<T, int>)
    info.default_value = int64_t{p.value};
  else
    info.default_value = static_cast<double>(p.value);
  return info;
}

inline ParameterInfo describe_part(const Triple& p, int part) {
  const Number<float> number{p.name, p.label, p.value[part], p.range, p.doc, p.unit, p.scale};
  ParameterInfo info = describe(number);
  info.name += Triple::kParts[part];
  return info;
}

inline ParameterInfo describe(const Toggle& p) {
  ParameterInfo info;
  info.name = p.name, info.label = p.label, info.doc = p.doc;
  info.type = ParameterType::toggle;
  info.default_value = p.value;
  return info;
}

template <class E>
ParameterInfo describe(const Choice<E>& p) {
  ParameterInfo info;
  info.name = p.name, info.label = p.label, info.doc = p.doc;
  info.type = ParameterType::choice;
  for (const Option& option : Options<E>::kOptions) {
    info.options.emplace_back(option.name);
    info.option_labels.emplace_back(option.label);
  }
  info.default_value = info.options[static_cast<size_t>(p.value)];
  return info;
}

inline ParameterInfo describe(const Text& p) {
  ParameterInfo info;
  info.name = p.name, info.label = p.label, info.doc = p.doc;
  info.type = ParameterType::choice;
  info.validate_text = p.accepts;
  for (const Option& option : p.offered) {
    info.options.emplace_back(option.name);
    info.option_labels.emplace_back(option.label);
  }
  info.default_value = p.value;
  return info;
}

// The value must have been checked against the description before.
template <class T>
void assign(Number<T>& p, const Value& value) {
  if (const auto* i = std::get_if<int64_t>(&value))
    p.value = static_cast<T>(*i);
  else
    p.value = static_cast<T>(std::get<double>(value));
}

inline void assign(Toggle& p, const Value& value) { p.value = std::get<bool>(value); }

inline void assign(Text& p, const Value& value) { p.value = std::get<std::string>(value); }

template <class E>
void assign(Choice<E>& p, const Value& value) {
  const auto& options = Options<E>::kOptions;
  for (size_t i = 0; i < options.size(); ++i)
    if (options[i].name == std::get<std::string>(value)) p.value = static_cast<E>(i);
}

template <class P>
void append_description(const P& p, std::vector<ParameterInfo>& infos) {
  if constexpr (std::is_same_v<P, Triple>)
    for (int part = 0; part < 3; ++part) infos.push_back(describe_part(p, part));
  else
    infos.push_back(describe(p));
}

// Gives the knob, or a part of it, the value if this is its name.
template <class P>
bool assign_if_named(P& p, std::string_view name, const Value& value) {
  if constexpr (std::is_same_v<P, Triple>) {
    for (int part = 0; part < 3; ++part) {
      if (name != std::string(p.name) + Triple::kParts[part]) continue;
      Number<float> number{p.name, p.label, 0, p.range, p.doc};
      assign(number, value);
      p.value[part] = number.value;
      return true;
    }
    return false;
  } else {
    if (name != p.name) return false;
    assign(p, value);
    return true;
  }
}

// The description of every knob in a tuple of references to knobs; default_value is the value that each has now.
template <class... P>
std::vector<ParameterInfo> describe_all(const std::tuple<P...>& knobs) {
  std::vector<ParameterInfo> infos;
  std::apply([&](const auto&... p) { (append_description(p, infos), ...); }, knobs);
  return infos;
}

// Gives the knob called `name` a value that was checked; false if there is no such knob.
template <class... P>
bool assign_by_name(const std::tuple<P...>& knobs, std::string_view name, const Value& value) {
  return std::apply([&](auto&... p) { return (assign_if_named(p, name, value) || ...); }, knobs);
}

const ParameterInfo* find_parameter(std::span<const ParameterInfo> infos, std::string_view name);

}  // namespace etendue
