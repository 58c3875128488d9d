#pragma once

#include <filesystem>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::jobs {

/// The signals of a file, or of a plan in a folder. Those of a plan of version 0.3 or earlier get their
/// light_hash from the store file of the plan, and count as incomplete if the plan was interrupted. Throws
/// InputError.
StoredSignals read_given_signals(const std::filesystem::path& signals);

}  // namespace shelfbeam::jobs
