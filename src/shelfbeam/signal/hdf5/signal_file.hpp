#pragma once

#include <cstdint>
#include <filesystem>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// The version that is written; no other version is read.
inline constexpr std::uint32_t signal_format_version = 1;

/// Writes the signal file (HDF5 after a checksum, docs/formats/signal.md) through a temporary file and a
/// rename. The content depends only on the matrix and has no time stamps. Throws OutputError if the file
/// cannot be written, and std::invalid_argument for a matrix that is empty or has arrays without m n entries;
/// flags may be missing.
void write_signal_file(const SignalMatrix& matrix, const std::filesystem::path& path);
void write_signal_file(const StoredSignals& signals, const std::filesystem::path& path);

/// Throws InputError for a file that is not HDF5 (or in its old format without checksums), is corrupt, has an
/// unknown format version, lacks a data set, has a data set of another shape, or contains NaN, infinite or
/// negative signals, errors, requirements or costs, or flags other than 0 and 1, or is a part of a
/// simulation. A mean may be negative by less than ten standard errors. Corruption of a file with a checksum
/// is always detected. Do not read untrusted files without a checksum, because the HDF5 library is not safe
/// against malicious files.
StoredSignals read_signal_file(const std::filesystem::path& path);

/// Whether the file begins like a signal file or with the HDF5 signature.
bool is_hdf5(const std::filesystem::path& path);

}  // namespace shelfbeam
