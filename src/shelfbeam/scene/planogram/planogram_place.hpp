#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "shelfbeam/scene/planogram/article_labels.hpp"

namespace shelfbeam {

/// A place of an article on a fixture of the store.
struct PlanogramPlace {
  std::string article, where, description;
  OwnStyle style;
  std::size_t fixture = 0;
  std::optional<Face> face;      ///< nothing for the top
  int level = 1;                 ///< from the lowest board
  double along = 0;              ///< m from the beginning of the edge
  std::optional<double> across;  ///< m from the front, on the top
};

}  // namespace shelfbeam
