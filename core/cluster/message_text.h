// Texts in messages.
#pragma once
#include <string>
#include <vector>

#include "base/state_bytes.h"

namespace etendue::cluster {

inline void write_text(StateWriter& out, const std::string& text) { out.list(std::span<const char>(text)); }

inline bool read_text(StateReader& in, std::string& text) {
  std::vector<char> letters;
  if (!in.list(letters)) return false;
  text.assign(letters.begin(), letters.end());
  return true;
}

}  // namespace etendue::cluster
