// Errors of files and arguments, returned as values. Violations of internal invariants are assertions instead.
#pragma once
#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace etendue {

// The kind of an error; the value is the exit code of the command line program.
enum class Fault { usage = 2, input = 3, output = 4, interrupted = 130 };

// `message` reads "FILE: what is wrong, where, and what would be right", without a full stop.
struct Error {
  Fault fault = Fault::input;
  std::string message;
};

inline Error usage_error(std::string message) { return {Fault::usage, std::move(message)}; }
inline Error input_error(std::string message) { return {Fault::input, std::move(message)}; }
inline Error output_error(std::string message) { return {Fault::output, std::move(message)}; }

// A value, or the error that occurred instead. Reading the value of an error throws std::bad_variant_access.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  explicit operator bool() const { return content_.index() == 0; }
  const T& operator*() const& { return std::get<0>(content_); }
  T& operator*() & { return std::get<0>(content_); }
  T&& operator*() && { return std::get<0>(std::move(content_)); }
  const T* operator->() const { return &std::get<0>(content_); }
  T* operator->() { return &std::get<0>(content_); }
  const Error& error() const { return std::get<1>(content_); }

 private:
  std::variant<T, Error> content_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  explicit operator bool() const { return !error_; }
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace etendue
