#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Writes a row-major matrix as CSV: a header with the transceiver ids, then one row per label, which begins
/// with the label's id. Nine significant digits preserve 32-bit values exactly. `safe`: as in `csv_field`.
void write_matrix_csv(const SignalMatrix& matrix, std::span<const float> values,
                      const std::filesystem::path& path, bool safe = false);

/// Writes a row-major matrix as NPY 1.0, little-endian float32, C order, without ids.
void write_matrix_npy(const SignalMatrix& matrix, std::span<const float> values,
                      const std::filesystem::path& path);

}  // namespace shelfbeam
