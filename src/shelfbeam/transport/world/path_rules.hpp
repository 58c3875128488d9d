#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// How paths between labels and light sources are sampled; a table in docs/methods/simulation.md lists the
/// paths that each strategy covers.
enum class Strategy {
  walk,     ///< walks from the label until they meet a source (2.15); sources need an area
  nee,      ///< walks from the label, with a connection to one source at every vertex (2.7.2)
  mis,      ///< both, combined by multiple importance sampling (2.7.3)
  particle  ///< walks from the source, with connections to all labels at every vertex
};
template <>
inline constexpr auto names_of<Strategy> = std::to_array<Named<Strategy>>({{"walk", Strategy::walk},
                                                                           {"nee", Strategy::nee},
                                                                           {"mis", Strategy::mis},
                                                                           {"particle", Strategy::particle}});

/// Exponent b of the weights of multiple importance sampling (2.19), mis_weights.hpp.
enum class Heuristic {
  balance,  ///< b = 1
  power     ///< b = 2
};
template <>
inline constexpr auto names_of<Heuristic> =
    std::to_array<Named<Heuristic>>({{"balance", Heuristic::balance}, {"power", Heuristic::power}});

/// How a ray left its last vertex, which determines whether connections also find the sources that it meets.
enum class Departure {
  scattered,  ///< by a non-specular lobe: connections find all sources
  mirrored,   ///< by one plane mirror, which a scattered ray met: connections find transceivers' images
  specular    ///< by other specular reflections or refractions: connections find no source
};

/// The departure after a specular reflection or refraction.
inline Departure after_specular(Departure before, bool is_imaged_reflection) {
  return before == Departure::scattered && is_imaged_reflection ? Departure::mirrored : Departure::specular;
}

struct PathRules {
  static constexpr std::uint32_t no_limit = std::numeric_limits<std::uint32_t>::max();

  Strategy strategy = Strategy::mis;
  Heuristic heuristic = Heuristic::balance;
  /// Maximum number of reflections and refractions; straight passage through a pane does not count.
  std::uint32_t max_bounces = no_limit;
  /// Whether walks sample the direct light and the mirror paths between label and source; otherwise
  /// direct.hpp computes both.
  bool samples_direct = true;

  /// Whether connections include mirror paths. Over one plane mirror, only connections find a transceiver
  /// (point or disc) and only walks find an emitting surface. For particles, connections find point labels.
  bool uses_images(bool point_label, bool is_transceiver) const {
    if (strategy == Strategy::walk || max_bounces == 0) return false;
    return strategy == Strategy::particle ? point_label : is_transceiver;
  }
};

/// Counts of the straight connections of random walks from labels (2.7.2).
struct ShadowRays {
  std::uint64_t connections = 0;  ///< attempted, each to one source
  std::uint64_t traced = 0;       ///< of these, with a contribution if nothing blocks the light
  std::uint64_t occluded = 0;     ///< of the traced connections, blocked by something opaque

  ShadowRays& operator+=(const ShadowRays& other) {
    connections += other.connections;
    traced += other.traced;
    occluded += other.occluded;
    return *this;
  }
};

/// Classes of path lengths; the last class includes all longer paths.
struct LengthSteps {
  double step = 1;          ///< m
  std::uint32_t count = 0;  ///< 0: no classes
};

}  // namespace shelfbeam
