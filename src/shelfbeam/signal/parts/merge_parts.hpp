#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace shelfbeam {

struct MergedParts {
  std::size_t labels = 0, candidates = 0, states = 0;  ///< states: 0 for a simulation of one
};

/// Joins the parts of a simulation, in any order, to the signal file that the whole simulation writes, byte
/// for byte (SimulationOptions::part). Only the signals of one state of the parts are in memory at a time.
/// Throws InputError that names the files if parts are missing or duplicate, or belong to different
/// simulations; OutputError if the output cannot be written.
MergedParts merge_parts(std::span<const std::filesystem::path> parts, const std::filesystem::path& output);

}  // namespace shelfbeam
