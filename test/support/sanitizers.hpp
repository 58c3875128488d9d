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

/// What limits of time that are to suffice for something are to be multiplied by.
#if defined(__SANITIZE_THREAD__)
inline constexpr double slowness = 10;
#else
inline constexpr double slowness = has_address_sanitizer ? 10 : 1;
#endif

}  // namespace shelfbeam::test
