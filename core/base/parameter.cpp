#include "base/parameter.h"

#include <charconv>
#include <cmath>
#include <cstdio>

#include "base/number_text.h"
#include "base/similar_name.h"

namespace etendue {
namespace {

std::string number_text(double x) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x).ptr;
  return std::string(buffer, end);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

Error invalid_value(const ParameterInfo& info, std::string_view text, const std::string& expected) {
  return usage_error(info.name + ": '" + std::string(text) + "' is not a valid value; expected " + expected);
}

// Limits of numbers are single-precision values: six digits are enough.
std::string expected_range(const ParameterInfo& info) {
  if (info.type == ParameterType::integer)
    return "an integer from " + number_text(info.min) + " to " + number_text(info.max);
  return "a number from " + format_number(info.min, 6) + " to " + format_number(info.max, 6);
}

// Whether the limit of a range is `d` in single precision: 0.001 is less than 0.001f.
bool rounds_to(double d, double limit) {
  return std::abs(d) < 1e38 && static_cast<float>(d) == static_cast<float>(limit);
}

template <class T>
bool parse_number(std::string_view text, T& out) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
}

ParameterInfo described(const char* name, const char* label, const char* doc, ParameterType type) {
  ParameterInfo info;
  info.name = name;
  info.label = label;
  info.doc = doc;
  info.type = type;
  return info;
}

template <class T>
ParameterInfo describe_number(const Number<T>& p, ParameterType type, Value value) {
  ParameterInfo info = described(p.name, p.label, p.doc, type);
  info.unit = p.unit;
  info.min = static_cast<double>(p.range.min);
  info.max = static_cast<double>(p.range.max);
  info.logarithmic = p.scale == Scale::logarithmic;
  info.default_value = std::move(value);
  return info;
}

}  // namespace

std::string to_string(const Value& value) {
  if (const auto* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
  if (const auto* i = std::get_if<int64_t>(&value)) return std::to_string(*i);
  if (const auto* d = std::get_if<double>(&value)) return number_text(*d);
  return std::get<std::string>(value);
}

std::string_view type_name(ParameterType type) {
  switch (type) {
    case ParameterType::toggle:
      return "toggle";
    case ParameterType::integer:
      return "integer";
    case ParameterType::number:
      return "number";
    case ParameterType::choice:
      return "choice";
  }
  return "";
}

Result<Value> parse_value(const ParameterInfo& info, std::string_view text) {
  switch (info.type) {
    case ParameterType::toggle:
      if (text == "true" || text == "on" || text == "1" || text == "yes") return Value(true);
      if (text == "false" || text == "off" || text == "0" || text == "no") return Value(false);
      return invalid_value(info, text, "true or false");
    case ParameterType::integer: {
      int64_t i = 0;
      if (!parse_number(text, i)) return invalid_value(info, text, expected_range(info));
      return checked_value(info, i);
    }
    case ParameterType::number: {
      double d = 0;
      if (!parse_number(text, d)) return invalid_value(info, text, expected_range(info));
      return checked_value(info, d);
    }
    case ParameterType::choice:
      return checked_value(info, std::string(text));
  }
  return invalid_value(info, text, "a value");
}

Result<Value> checked_value(const ParameterInfo& info, const Value& value) {
  const std::string text = to_string(value);
  switch (info.type) {
    case ParameterType::toggle:
      if (std::holds_alternative<bool>(value)) return value;
      return invalid_value(info, text, "true or false");
    case ParameterType::integer: {
      const auto* i = std::get_if<int64_t>(&value);
      if (i && static_cast<double>(*i) >= info.min && static_cast<double>(*i) <= info.max) return value;
      return invalid_value(info, text, expected_range(info));
    }
    case ParameterType::number: {
      double d = std::nan("");
      if (const auto* i = std::get_if<int64_t>(&value)) d = static_cast<double>(*i);
      if (const auto* f = std::get_if<double>(&value)) d = *f;
      if (d >= info.min && d <= info.max) return Value(d);
      for (const double limit : {info.min, info.max})
        if (rounds_to(d, limit)) return Value(limit);
      return invalid_value(info, text, expected_range(info));
    }
    case ParameterType::choice:
      for (const auto& option : info.options)
        if (std::holds_alternative<std::string>(value) && option == text) return value;
      if (info.validate_text && std::holds_alternative<std::string>(value)) {
        if (auto accepted = info.validate_text(text); !accepted)
          return usage_error(info.name + ": " + accepted.error().message);
        return value;
      }
      return invalid_value(info, text, "one of " + joined(info.options) + did_you_mean(text, info.options));
  }
  return value;
}

const ParameterInfo* find_parameter(std::span<const ParameterInfo> infos, std::string_view name) {
  for (const auto& info : infos)
    if (info.name == name) return &info;
  return nullptr;
}

ParameterInfo describe(const Number<int>& p) { return describe_number(p, ParameterType::integer, int64_t{p.value}); }

ParameterInfo describe(const Number<float>& p) {
  return describe_number(p, ParameterType::number, static_cast<double>(p.value));
}

ParameterInfo describe(const Toggle& p) {
  ParameterInfo info = described(p.name, p.label, p.doc, ParameterType::toggle);
  info.default_value = p.value;
  return info;
}

ParameterInfo describe_choice(const char* name, const char* label, const char* doc, std::span<const Option> options,
                              size_t selected) {
  ParameterInfo info = described(name, label, doc, ParameterType::choice);
  for (const Option& option : options) {
    info.options.emplace_back(option.name);
    info.option_labels.emplace_back(option.label);
  }
  if (selected < info.options.size()) info.default_value = info.options[selected];
  return info;
}

ParameterInfo describe(const Text& p) {
  ParameterInfo info = describe_choice(p.name, p.label, p.doc, p.presets, 0);
  info.validate_text = p.validate;
  info.default_value = p.value;
  return info;
}

}  // namespace etendue
