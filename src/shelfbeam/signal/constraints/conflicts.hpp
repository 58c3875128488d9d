#pragma once

#include <filesystem>
#include <string>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

// Both functions add to SignalTable::conflicts.

/// Adds a conflict for every two candidates closer to each other than `metres` (straight line, with a
/// tolerance of 1e-6 m). Options of one mounting point need no conflict, because at most one of them can be
/// chosen; nor do two installed units. Throws InputError, which names the matrix as `name`, if a unit has no
/// position.
void add_conflicts(SignalTable& table, double metres, const std::string& name);

/// Adds conflicts from a CSV with header `a,b`, ids of transceivers. Throws InputError with file and line for
/// an unknown id, a unit paired with itself, and two installed units.
void forbid_pairs(SignalTable& table, const std::filesystem::path& csv);

}  // namespace shelfbeam
