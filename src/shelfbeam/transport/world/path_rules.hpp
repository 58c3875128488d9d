#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// How paths between labels and light sources are sampled; docs/methods/simulation.md has a table of the
/// paths that each of them covers.
enum class Strategy {
  walk,     ///< from the label, until a source is met (2.15): sources need an area
  nee,      ///< from the label, with a connection to a source at every vertex (2.7.2)
  mis,      ///< both, weighted against each other (2.7.3)
  particle  ///< from the source, with connections to all labels at every vertex
};
template <>
inline constexpr auto names_of<Strategy> = std::to_array<Named<Strategy>>({{"walk", Strategy::walk},
                                                                           {"nee", Strategy::nee},
                                                                           {"mis", Strategy::mis},
                                                                           {"particle", Strategy::particle}});

/// Weights of multiple importance sampling (2.19), next_event.hpp.
enum class Heuristic {
  balance,  ///< b = 1
  power     ///< b = 2
};
template <>
inline constexpr auto names_of<Heuristic> = std::to_array<Named<Heuristic>>({{"balance", Heuristic::balance},
                                                                             {"power", Heuristic::power}});

/// How a ray has left its last vertex, which decides whether connections find the sources that it meets.
enum class Departure {
  scattered,  ///< connections find all sources
  mirrored,  ///< over one plane mirror, to which a scattered ray led: connections find images of transceivers
  specular   ///< otherwise by mirrors or refraction: connections find nothing
};

/// After a specular reflection or refraction.
inline Departure after_specular(Departure before, bool is_imaged_reflection) {
  return before == Departure::scattered && is_imaged_reflection ? Departure::mirrored : Departure::specular;
}

struct PathRules {
  static constexpr std::uint32_t no_limit = std::numeric_limits<std::uint32_t>::max();

  Strategy strategy = Strategy::mis;
  Heuristic heuristic = Heuristic::balance;
  /// Longest paths, in reflections and refractions; going straight through a pane is neither.
  std::uint32_t max_bounces = no_limit;
  /// Whether walks sample the light that comes without a bounce, and over one plane mirror from end to end;
  /// otherwise `direct` below computes it.
  bool samples_direct = true;

  /// Whether connections look for plane mirrors: over these a transceiver, point or disc, is met by its image
  /// alone, an emitting surface by walks alone. Of particles, a label is met by its image if it is a point.
  bool uses_images(bool point_label, bool is_transceiver) const {
    if (strategy == Strategy::walk || max_bounces == 0) return false;
    return strategy == Strategy::particle ? point_label : is_transceiver;
  }
};

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

/// Classes of path lengths; the last takes all longer ones, too.
struct LengthSteps {
  double step = 1;          ///< m
  std::uint32_t count = 0;  ///< 0: lengths are not told apart
};

}  // namespace shelfbeam
