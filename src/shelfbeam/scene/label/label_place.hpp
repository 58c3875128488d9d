#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// A side of a fixture before its rotation: front faces -y, back +y, left -x and right +x.
enum class Face { front, back, left, right };
template <>
inline constexpr auto names_of<Face> = std::to_array<Named<Face>>(
    {{"front", Face::front}, {"back", Face::back}, {"left", Face::left}, {"right", Face::right}});

/// The place of a label as a person in the shop finds it. It is for messages and reports: no result depends
/// on it, and it is not part of store_hash.
///
/// Labels of a fixture and of a planogram have the place that the store gives them. That of any other label
/// follows from its position (label_places.hpp), so a resolved store has places, too.
struct LabelPlace {
  std::string fixture = {};              ///< id of a fixture or of an inner wall; empty: of none
  std::optional<std::size_t> wall = {};  ///< number of a wall of the room, if it is of no fixture
  std::optional<Face> face = {};         ///< of a gondola, a freezer or a box
  bool on_top = false;                   ///< on top of the fixture, facing up
  int board = 0;                         ///< from 1, the lowest board of the face; 0: of none
  double along = 0;                      ///< m from the beginning of the face's edge or of the wall

  bool is_known() const { return !fixture.empty() || wall.has_value(); }
  friend bool operator==(const LabelPlace&, const LabelPlace&) = default;
};

}  // namespace shelfbeam
