#pragma once

#include <filesystem>
#include <string>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

// Both add to SignalTable::apart.

/// Candidates closer to each other than `metres` (straight line, less the 1e-6 m within which places are
/// equal) must not be chosen together. Options of one mounting point exclude one another already; two
/// installed units hang already, however near. Throws InputError where a unit has no position; `name` stands
/// for the matrix in it.
void keep_apart(SignalTable& table, double metres, const std::string& name);

/// Pairs from a CSV with header `a,b`, ids of transceivers. Throws InputError with file and line for an
/// unknown id, for a unit and itself, and for two installed units.
void forbid_pairs(SignalTable& table, const std::filesystem::path& csv);

}  // namespace shelfbeam
