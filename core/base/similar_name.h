// The name that a user may have meant.
#pragma once
#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace etendue {

// The Levenshtein distance of two words.
inline size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitution = diagonal + (a[i - 1] != b[j - 1] ? 1 : 0);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, substitution}));
    }
  }
  return row.back();
}

// The most similar of the names, the first of equally similar ones. Empty without names.
inline std::string similar_name(std::string_view name, std::span<const std::string> names) {
  std::string nearest;
  size_t least = SIZE_MAX;
  for (const std::string& candidate : names)
    if (const size_t d = edit_distance(name, candidate); d < least) {
      least = d;
      nearest = candidate;
    }
  return nearest;
}

// The name that was probably meant: at most two letters, and half of them, are wrong. Empty if no name is so similar.
inline std::string probable_name(std::string_view name, std::span<const std::string> names) {
  constexpr size_t kMostErrors = 2;
  const std::string similar = similar_name(name, names);
  return edit_distance(name, similar) <= std::min(kMostErrors, name.size() / 2) ? similar : "";
}

// The same as a question at the end of a message, "; did you mean 'NAME'?", or empty.
inline std::string did_you_mean(std::string_view name, std::span<const std::string> names) {
  const std::string probable = probable_name(name, names);
  return probable.empty() ? "" : "; did you mean '" + probable + "'?";
}

}  // namespace etendue
