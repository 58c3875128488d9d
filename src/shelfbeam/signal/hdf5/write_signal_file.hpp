#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"

namespace shelfbeam {

/// Provides the entries of a signal matrix row by row on request, for matrices in another representation. The
/// functions fill `values`, one per column.
struct SignalRows {
  /// A quantity of the matrix, or of a layer: SignalMatrix::by_bounce, then by_length. Layers have no direct
  /// part.
  enum class Quantity { mean, standard_error, direct };
  struct Source {
    Quantity quantity = Quantity::mean;
    std::optional<std::size_t> layer = {};
  };

  std::function<void(const Source& source, std::size_t row, std::span<float> values)> fill;
  std::function<void(std::size_t row, std::span<std::uint8_t> values)> fill_flags;  ///< empty: unknown
  std::size_t bounce_layers = 0, length_layers = 0;
};

/// Like `write_signal_file` (signal_file.hpp), but the caller commits the file.
void write_signal_file(const SignalMatrix& matrix, AtomicFile& target);

/// The same with the entries from `rows`, a few rows at a time; the entries of `head` are ignored.
void write_signal_file(const StoredSignals& head, const SignalRows& rows, const std::filesystem::path& path);

}  // namespace shelfbeam
