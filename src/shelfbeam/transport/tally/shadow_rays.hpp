#pragma once

#include <cstdint>

namespace shelfbeam {

/// What became of the straight connections that random walks from labels tried (2.7.2).
struct ShadowRays {
  std::uint64_t connections = 0;  ///< tried, each to one source
  std::uint64_t traced = 0;       ///< of these: those that would bring light if nothing stood between
  std::uint64_t occluded = 0;     ///< of these: those of which something opaque takes all light

  ShadowRays& operator+=(const ShadowRays& other) {
    connections += other.connections;
    traced += other.traced;
    occluded += other.occluded;
    return *this;
  }
};

}  // namespace shelfbeam
