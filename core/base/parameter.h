// Parameters: values that a user can set, declared once and described to every interface
//
// Declaration. A parameter is a member of the class that it controls. The function `parameters` lists all of them:
//
//   class Path {
//     Number<int> roulette_start{"roulette-start", "Russian roulette start depth", 4, {1, 64},
//                                "Path depth at which termination begins. Lower is faster and noisier."};
//     Toggle weighted{"weighted", "Apply MIS weights", true, "Off: every technique counts fully."};
//     auto parameters() { return std::tie(roulette_start, weighted); }
//   };
//
//   Type        Value         Members
//   Number<T>   int or float  name, label, value, range, doc, unit, scale
//   Triple      Vec3          as Number; its components are three parameters NAME.r, NAME.g and NAME.b
//   Toggle      bool          name, label, value, doc
//   Choice<E>   enum E        name, label, value, doc; Options<E> lists the names and labels of the enumerators
//   Text        std::string   name, label, value, doc, validate, presets
//
//   name        identifies the parameter in files and on the command line: lower case, words joined by hyphens
//   label       is shown to the user
//   value       is the default until it is set
//   doc         is the tooltip and the text of the manual: what the parameter does, the effect of raising it
//   unit        is shown after a number, like "m"; empty if it has none
//
// Use in computations. A Number, Toggle, Choice or Text converts to its value: `if (depth >= roulette_start) ...`.
//
// Generic access. Widgets, `--set`, `list --json`, saved states, undo and the generated manual use the type-erased
// form:
//
//   describe_all(path.parameters())                            -> one ParameterInfo per parameter
//   parse_value(info, "8")  or  checked_value(info, value)     -> a valid Value, or an error with the valid range
//   assign_by_name(path.parameters(), "roulette-start", value)    sets the member
//
// Thread safety: parameters are set before an object is shared between threads.
#pragma once
#include <cstdint>
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

// ---- Type-erased values and descriptions

// The value of any parameter. The value of a choice is the name of the option.
using Value = std::variant<bool, int64_t, double, std::string>;

// The value as JSON of any library whose values can be made from bool, int64_t, double and std::string.
template <class Json>
Json to_json_value(const Value& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

// A value for the parameter of this name.
struct Setting {
  std::string name;
  Value value;
};

enum class ParameterType { toggle, integer, number, choice };

// "toggle", "integer", "number" or "choice".
std::string_view type_name(ParameterType type);

struct ParameterInfo {
  std::string name, label, unit, doc;
  ParameterType type = ParameterType::number;
  double min = 0, max = 0;   // inclusive; integers and numbers only
  bool logarithmic = false;  // a slider for this number should be logarithmic
  Value default_value = false;
  std::vector<std::string> options, option_labels;  // choices only
  // Set for Text parameters, which are choices that also take other texts. Returns an error for an invalid text.
  Result<void> (*validate_text)(std::string_view) = nullptr;
};

// The value as `parse_value` reads it; numbers have as many digits as they need to be read back exactly.
std::string to_string(const Value& value);

// Parses a value of this parameter: true/false, on/off, yes/no or 1/0; a number in the range; the name of an option.
// An invalid text is a usage error that names the valid values.
Result<Value> parse_value(const ParameterInfo& info, std::string_view text);

// `value` if its type is right and it lies in the range. An integer is converted where a number is expected.
Result<Value> checked_value(const ParameterInfo& info, const Value& value);

// The parameter of this name, or null.
const ParameterInfo* find_parameter(std::span<const ParameterInfo> infos, std::string_view name);

// ---- Declarations

// Inclusive.
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

struct Triple {
  static constexpr const char* kParts[3] = {".r", ".g", ".b"};

  const char* name;
  const char* label;
  Vec3 value;
  Range<float> range;
  const char* doc;
  const char* unit = "";
  Scale scale = Scale::linear;

  Number<float> component(int i) const { return {name, label, value[i], range, doc, unit, scale}; }
  std::string component_name(int i) const { return std::string(name) + kParts[i]; }
};

struct Toggle {
  const char* name;
  const char* label;
  bool value;
  const char* doc;

  operator bool() const { return value; }  // NOLINT(google-explicit-constructor)
};

struct Option {
  const char* name;
  const char* label;
};

// Specialise for an enumeration E with
//   static constexpr std::array<Option, N> kOptions
// in the order of the enumerators, whose values must be 0 to N - 1.
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

struct Text {
  const char* name;
  const char* label;
  std::string value;
  const char* doc;
  Result<void> (*validate)(std::string_view);  // an error for an invalid text
  std::vector<Option> presets;                 // texts that interfaces offer, the default first

  operator const std::string&() const { return value; }  // NOLINT(google-explicit-constructor)
};

// ---- Description of a declared parameter; default_value is its current value

ParameterInfo describe(const Number<int>& p);
ParameterInfo describe(const Number<float>& p);
ParameterInfo describe(const Toggle& p);
ParameterInfo describe(const Text& p);
// A choice with these options; `selected` is the index of the current one.
ParameterInfo describe_choice(const char* name, const char* label, const char* doc, std::span<const Option> options,
                              size_t selected);

template <class E>
ParameterInfo describe(const Choice<E>& p) {
  return describe_choice(p.name, p.label, p.doc, Options<E>::kOptions, static_cast<size_t>(p.value));
}

template <class P>
void append_description(const P& p, std::vector<ParameterInfo>& infos) {
  if constexpr (std::is_same_v<P, Triple>) {
    for (int i = 0; i < 3; ++i) {
      infos.push_back(describe(p.component(i)));
      infos.back().name = p.component_name(i);
    }
  } else {
    infos.push_back(describe(p));
  }
}

// One description for each parameter of a tuple of references, three for a Triple.
template <class... P>
std::vector<ParameterInfo> describe_all(const std::tuple<P...>& parameters) {
  std::vector<ParameterInfo> infos;
  std::apply([&](const auto&... p) { (append_description(p, infos), ...); }, parameters);
  return infos;
}

// ---- Assignment; the value must have passed `checked_value` or `parse_value`

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

// Sets the parameter, or a component of it, if `name` is its name; returns whether it is.
template <class P>
bool assign_if_named(P& p, std::string_view name, const Value& value) {
  if constexpr (std::is_same_v<P, Triple>) {
    for (int i = 0; i < 3; ++i) {
      if (name != p.component_name(i)) continue;
      Number<float> component = p.component(i);
      assign(component, value);
      p.value[i] = component.value;
      return true;
    }
    return false;
  } else {
    if (name != p.name) return false;
    assign(p, value);
    return true;
  }
}

// Sets the parameter of this name in a tuple of references; false if there is none.
template <class... P>
bool assign_by_name(const std::tuple<P...>& parameters, std::string_view name, const Value& value) {
  return std::apply([&](auto&... p) { return (assign_if_named(p, name, value) || ...); }, parameters);
}

}  // namespace etendue
