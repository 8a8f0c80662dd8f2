#include "base/parameter.h"

#include <charconv>
#include <cmath>
#include <cstdio>

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

Error wrong(const ParameterInfo& info, std::string_view text, const std::string& expected) {
  return usage_error(info.name + ": '" + std::string(text) + "' is not a value it can take; give " + expected);
}

std::string expected_range(const ParameterInfo& info) {
  return std::string(info.type == ParameterType::integer ? "an integer" : "a number") + " from " +
         number_text(info.min) + " to " + number_text(info.max);
}

template <class T>
bool parse_number(std::string_view text, T& out) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
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
      return wrong(info, text, "true or false");
    case ParameterType::integer: {
      int64_t i = 0;
      if (!parse_number(text, i)) return wrong(info, text, expected_range(info));
      return checked_value(info, i);
    }
    case ParameterType::number: {
      double d = 0;
      if (!parse_number(text, d)) return wrong(info, text, expected_range(info));
      return checked_value(info, d);
    }
    case ParameterType::choice:
      return checked_value(info, std::string(text));
  }
  return wrong(info, text, "a value");
}

Result<Value> checked_value(const ParameterInfo& info, const Value& value) {
  const std::string text = to_string(value);
  switch (info.type) {
    case ParameterType::toggle:
      if (std::holds_alternative<bool>(value)) return value;
      return wrong(info, text, "true or false");
    case ParameterType::integer: {
      const auto* i = std::get_if<int64_t>(&value);
      if (i && static_cast<double>(*i) >= info.min && static_cast<double>(*i) <= info.max) return value;
      return wrong(info, text, expected_range(info));
    }
    case ParameterType::number: {
      double d = std::nan("");
      if (const auto* i = std::get_if<int64_t>(&value)) d = static_cast<double>(*i);
      if (const auto* f = std::get_if<double>(&value)) d = *f;
      if (d >= info.min && d <= info.max) return Value(d);
      return wrong(info, text, expected_range(info));
    }
    case ParameterType::choice:
      for (const auto& option : info.options)
        if (std::holds_alternative<std::string>(value) && option == text) return value;
      if (info.validate_text && std::holds_alternative<std::string>(value)) {
        if (auto accepted = info.validate_text(text); !accepted)
          return usage_error(info.name + ": " + accepted.error().message);
        return value;
      }
      return wrong(info, text, "one of " + joined(info.options));
  }
  return value;
}

const ParameterInfo* find_parameter(std::span<const ParameterInfo> infos, std::string_view name) {
  for (const auto& info : infos)
    if (info.name == name) return &info;
  return nullptr;
}

}  // namespace etendue
