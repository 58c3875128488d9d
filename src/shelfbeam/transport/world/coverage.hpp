#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/names.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// One end of a path.
enum class PathEnd : std::uint8_t {
  point_labels,
  sized_labels,
  point_transceivers,
  disc_transceivers,
  emitting_surfaces
};
template <>
inline constexpr auto names_of<PathEnd> =
    std::to_array<Named<PathEnd>>({{"point_labels", PathEnd::point_labels},
                                   {"sized_labels", PathEnd::sized_labels},
                                   {"point_transceivers", PathEnd::point_transceivers},
                                   {"disc_transceivers", PathEnd::disc_transceivers},
                                   {"emitting_surfaces", PathEnd::emitting_surfaces}});

/// The way between the ends.
enum class PathWay : std::uint8_t { any, successive_mirrors, solid_glass, small_mirrors, mirrors_and_glass };
template <>
inline constexpr auto names_of<PathWay> =
    std::to_array<Named<PathWay>>({{"any", PathWay::any},
                                   {"successive_mirrors", PathWay::successive_mirrors},
                                   {"solid_glass", PathWay::solid_glass},
                                   {"small_mirrors", PathWay::small_mirrors},
                                   {"mirrors_and_glass", PathWay::mirrors_and_glass}});

/// A kind of light.
struct LightKind {
  PathEnd end = PathEnd::point_transceivers;
  PathWay way = PathWay::any;
  std::vector<MaterialId> materials = {};  ///< of the mirrors and the glass; none for any way
  std::uint64_t mirrors = 0;               ///< number of small mirrors

  bool operator==(const LightKind&) const = default;
};

/// Each kind of light that a strategy cannot find in this scene and omits from the signals; none if every
/// path is covered. A connection joins a point transceiver (for particles: a point label) to a surface or
/// label: straight, through panes, or over one plane mirror. Longer paths over mirrors and paths through
/// solid glass end at a point that no random direction meets.
std::vector<LightKind> uncovered_light(const Scene& scene, Strategy strategy = Strategy::mis);

/// Each kind of light that a strategy finds only by chance. Such light has large standard errors, and entries
/// that rest on a few such paths are flagged (SignalMatrix::flags).
std::vector<LightKind> chance_light(const Scene& scene, Strategy strategy = Strategy::mis);

}  // namespace shelfbeam
