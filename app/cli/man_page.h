// The manual page for man(1), from the descriptions of the subcommands.
#pragma once
#include <string>

namespace etendue::cli {

// Text in the macro language man(7).
std::string man_page();

}  // namespace etendue::cli
