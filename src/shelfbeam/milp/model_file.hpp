#pragma once

#include <filesystem>

#include "shelfbeam/milp/model.hpp"

namespace shelfbeam::milp {

/// Both writers: numbers round-trip exactly; names are made safe for either format (letters, digits and
/// underscores, unique, at most 60 characters), the same in both; a row bounded on both sides with different
/// values becomes two rows; a row without a bound is left out. Throws InputError when `path` cannot be
/// written.

/// Free-format MPS.
void write_mps(const Model& model, const std::filesystem::path& path);

/// CPLEX LP format.
void write_lp(const Model& model, const std::filesystem::path& path);

}  // namespace shelfbeam::milp
