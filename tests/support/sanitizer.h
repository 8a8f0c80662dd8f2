// Whether the tests are built with a sanitizer (cmake --preset asan or tsan): programs are then five to ten times slower.
#pragma once

namespace etendue::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kHasSanitizer = true;
#else
inline constexpr bool kHasSanitizer = false;
#endif

}  // namespace etendue::test
