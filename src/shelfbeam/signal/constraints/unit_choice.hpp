#pragma once

#include <string>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The user's decisions about single units, by ids or patterns ('*' and '?').
struct UnitChoice {
  std::vector<std::string> pinned;    ///< part of every selection
  std::vector<std::string> excluded;  ///< part of no selection

  /// Marks the pinned units and removes the columns of the excluded ones. `name` is the name of the matrix in
  /// errors. Throws InputError for a pattern that matches no column (or excluded unit), for an excluded unit
  /// that is installed or pinned, for two pinned or installed units at one mounting point, and if no column
  /// is left.
  void apply(SignalTable& table, const std::string& name) const;
};

}  // namespace shelfbeam
