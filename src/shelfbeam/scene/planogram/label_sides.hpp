#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "shelfbeam/scene/fixture/edge_place.hpp"
#include "shelfbeam/scene/fixture/fixture.hpp"

namespace shelfbeam {

/// Where a fixture carries labels of articles: edges at these heights on each of these sides, and the top.
struct LabelSides {
  Footing footing;
  std::vector<Face> faces;
  std::vector<double> heights;  ///< m, from the lowest
  std::optional<double> top;    ///< m, of labels that lie on it

  // A face, or nothing for the top.

  bool has(const std::optional<Face>& face) const;
  std::size_t levels(const std::optional<Face>& face) const { return face ? heights.size() : 1; }
  double length(const std::optional<Face>& face) const {
    return face ? edge_length(footing, *face) : footing.length;
  }
};

/// Nothing for a fixture without sides. A gondola without boards has no heights. A box, such as a table, has
/// one edge below its top.
std::optional<LabelSides> label_sides(const Fixture& fixture);

/// The position and normal of a label in the store.
EdgePlace in_store(const Footing& footing, const EdgePlace& local);

}  // namespace shelfbeam
