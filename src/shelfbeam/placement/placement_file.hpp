#pragma once

#include <filesystem>
#include <string>

#include "shelfbeam/placement/placement.hpp"

namespace shelfbeam {

/// placement.json as docs/formats/placement.md describes it; the same answer gives the same text, but for
/// `seconds`.
std::string placement_json(const Placement& placement, const SignalTable& table);

/// Reads a placement.json against the table it belongs to. Throws InputError with file and place; an id that
/// the table does not have is one.
Placement read_placement(const std::filesystem::path& path, const SignalTable& table);

}  // namespace shelfbeam
