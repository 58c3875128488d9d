#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Writes a row-major matrix as CSV: a header row with transceiver ids, then a row a label with its id first;
/// nine significant digits, so that 32-bit values survive the round trip.
void write_matrix_csv(const SignalMatrix& matrix, std::span<const float> values,
                      const std::filesystem::path& path);

/// Writes a row-major matrix as NPY 1.0, little-endian float32, C order; ids are not kept.
void write_matrix_npy(const SignalMatrix& matrix, std::span<const float> values,
                      const std::filesystem::path& path);

}  // namespace shelfbeam
