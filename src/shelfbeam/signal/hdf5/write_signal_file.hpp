#pragma once

#include <filesystem>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/signal_rows.hpp"

namespace shelfbeam {

/// `write_signal_file` (signal_file.hpp) without the rename: the caller commits.
void write_signal_file(const SignalMatrix& matrix, AtomicFile& target);

/// The same with the entries from elsewhere, a few rows at a time; those of `head` are not used.
void write_signal_file(const SignalMatrix& head, const SignalRows& rows, const std::filesystem::path& path);

}  // namespace shelfbeam
