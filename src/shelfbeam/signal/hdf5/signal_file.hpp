#pragma once

#include <cstdint>
#include <filesystem>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Written, and the only one that is read.
inline constexpr std::uint32_t signal_format_version = 1;

/// Writes the signal file (HDF5 behind a checksum, docs/formats/signal.md) through a temporary file and a
/// rename. The content depends on the matrix alone: no time stamps. Throws InputError when it cannot be
/// written, and std::invalid_argument for a matrix that is empty or whose arrays are not all of m n entries;
/// flags may be missing.
void write_signal_file(const SignalMatrix& matrix, const std::filesystem::path& path);

/// Throws InputError for a file that is not HDF5 (or in its old format without checksums), is damaged, is of
/// an unknown format version, lacks a data set or has one of another shape, or holds NaN, infinite or
/// negative signals, errors, requirements or costs, or flags other than 0 and 1. A mean may be negative by
/// less than ten standard errors. Damage to a file with a checksum is always found; a file without one should
/// not come from a stranger, as the HDF5 library is not safe against what may be in it.
SignalMatrix read_signal_file(const std::filesystem::path& path);

/// True when the file begins as a signal file, or with the HDF5 signature.
bool is_hdf5(const std::filesystem::path& path);

}  // namespace shelfbeam
