// Whether the tests are built with a sanitizer (cmake --preset asan or tsan): programs are then five to ten times slower.
#pragma once

namespace etendue::test {

// GCC defines macros, Clang has features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kHasSanitizer = true;
#elif defined(__has_feature)
inline constexpr bool kHasSanitizer = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kHasSanitizer = false;
#endif

}  // namespace etendue::test
