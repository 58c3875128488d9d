#pragma once

#include <filesystem>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::detail {

/// What read_signal_file does in its child process: the HDF5 library reads here. For files that have been
/// read there, by who wants to see the reading itself (fuzzers count what code it reaches).
SignalMatrix read_signal_file_here(const std::filesystem::path& path);

}  // namespace shelfbeam::detail
