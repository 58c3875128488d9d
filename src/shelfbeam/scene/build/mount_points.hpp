#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// The most candidates that an area, a rail or a member of `on` can have, their memory, and its location.
struct MountCount {
  std::size_t candidates = 0;
  double bytes = 0;
  const std::string& where;  ///< in the store
  std::string fault;         ///< of its key `face`
};
std::vector<MountCount> candidate_counts(const Store& store, const Scene& scene);

using UseCandidate = std::function<void(const Transceiver&, const std::string& where)>;

/// An area or a member of `on` without candidates, and why its first point has none.
struct EmptyMount {
  const std::string& where;  ///< in the store
  std::string problem;
  static constexpr const char* remedy = "correct its place, height or spacing, or remove it";
};

/// Calls `use(unit, where)` for the candidates of grids, areas, rails and faces of a store whose scene has
/// its room and its fixtures. Points of areas and faces outside the room and within inner walls are omitted,
/// and those before an opening, above a fixture or below it. `omitted`: locations of those that are left out.
std::vector<EmptyMount> generate_candidates(const Store& store, const Scene& scene,
                                            const std::set<std::string>& omitted, const UseCandidate& use);

}  // namespace shelfbeam
