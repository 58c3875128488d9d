#pragma once

namespace shelfbeam::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool has_address_sanitizer = true;
#elif defined(__has_feature)
inline constexpr bool has_address_sanitizer = __has_feature(address_sanitizer);
#else
inline constexpr bool has_address_sanitizer = false;
#endif

#if defined(__SANITIZE_THREAD__)
inline constexpr bool has_thread_sanitizer = true;
#else
inline constexpr bool has_thread_sanitizer = false;
#endif

/// Whether a memory limit can be tested. These sanitizers reserve all addresses, and exit if memory is
/// refused.
inline constexpr bool memory_can_be_limited = !has_address_sanitizer && !has_thread_sanitizer;

/// Factor for time limits within which work must finish.
inline constexpr double slowness = has_address_sanitizer || has_thread_sanitizer ? 10 : 1;

}  // namespace shelfbeam::test
