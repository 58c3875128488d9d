#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// Requirements on a placement besides those of the matrix, from files and values.
struct TableConstraints {
  std::vector<std::filesystem::path> costs;      ///< CSV (apply_costs)
  double min_spacing = 0;                        ///< m between new units and all others; 0: none
  std::vector<std::filesystem::path> forbidden;  ///< CSV (forbid_pairs)

  /// `name` is the name of the matrix in errors. Throws InputError.
  void apply(SignalTable& table, const std::string& name) const;
};

}  // namespace shelfbeam
