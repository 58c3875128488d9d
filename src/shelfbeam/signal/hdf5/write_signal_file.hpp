#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"

namespace shelfbeam {

/// Provides the entries of a signal matrix row by row on request, for matrices in another representation.
class SignalRows {
 public:
  enum class Quantity { mean, standard_error, direct };

  virtual ~SignalRows() = default;
  /// Fills `values`, one per column.
  virtual void fill(Quantity quantity, std::size_t row, std::span<float> values) const = 0;
  /// Whether SignalMatrix::flags is known.
  virtual bool has_flags() const = 0;
  /// Fills the flags, one per column.
  virtual void fill_flags(std::size_t row, std::span<std::uint8_t> flags) const = 0;
  /// Fills a row of a layer: SignalMatrix::by_bounce, then by_length. Layers have no direct part.
  virtual void fill_layer(std::size_t layer, Quantity quantity, std::size_t row,
                          std::span<float> values) const = 0;
  /// Numbers of layers; 0 unless requested.
  virtual std::size_t bounce_layers() const = 0;
  virtual std::size_t length_layers() const = 0;
};

/// Like `write_signal_file` (signal_file.hpp), but the caller commits the file.
void write_signal_file(const SignalMatrix& matrix, AtomicFile& target);

/// The same with the entries from `rows`, a few rows at a time; the entries of `head` are ignored.
void write_signal_file(const StoredSignals& head, const SignalRows& rows, const std::filesystem::path& path);

}  // namespace shelfbeam
