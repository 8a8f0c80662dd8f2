// A page of HTML that stands alone: one file, no other is asked for, in the light or dark that its reader prefers.
#pragma once
#include <string>

namespace etendue::bench {

// `title` is plain text, `body` is HTML. A policy in the head forbids the page to load anything.
std::string page(const std::string& title, const std::string& body);

}  // namespace etendue::bench
