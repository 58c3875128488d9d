#pragma once

namespace shelfbeam::test {

/// Whether the address sanitizer is on: it ends the program where memory is refused, so tests of limits of
/// memory cannot be.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool has_address_sanitizer = true;
#elif defined(__has_feature)
inline constexpr bool has_address_sanitizer = __has_feature(address_sanitizer);
#else
inline constexpr bool has_address_sanitizer = false;
#endif

}  // namespace shelfbeam::test
