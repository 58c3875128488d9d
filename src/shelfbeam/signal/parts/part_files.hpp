#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/signal/hdf5/signal_part.hpp"

namespace shelfbeam::detail {

/// Opens all parts of a simulation, given in any order, in their order. Throws InputError that names the
/// files if parts are missing or duplicate.
std::vector<SignalPart> open_parts(std::span<const std::filesystem::path> paths);

/// Throws InputError if a part belongs to a different simulation from the first.
void expect_same(const SignalPart& file, const StoredSignals& part, const SignalPart& first_file,
                 const StoredSignals& first);

/// Throws InputError that names the part.
[[noreturn]] void refuse(
    const SignalPart& part, const std::string& problem,
    const std::string& suggestion = "use only parts of the same store, with the same options");

}  // namespace shelfbeam::detail
