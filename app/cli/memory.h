// What the process has used at most.
#pragma once
#include <cstddef>

namespace etendue::cli {

size_t peak_memory();  // bytes of resident memory

}  // namespace etendue::cli
