#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"

namespace shelfbeam {

/// The entries of a signal matrix, row by row when they are asked for: for matrices that are held in another
/// form.
class SignalRows {
 public:
  enum class Quantity { mean, standard_error, direct };

  virtual ~SignalRows() = default;
  /// Fills `values`, one a column.
  virtual void fill(Quantity quantity, std::size_t row, std::span<float> values) const = 0;
  /// Whether it is known what SignalMatrix::flags says.
  virtual bool has_flags() const = 0;
  /// That, one a column.
  virtual void fill_flags(std::size_t row, std::span<std::uint8_t> flags) const = 0;
  /// The same of a layer: SignalMatrix::by_bounce, then by_length; has no direct part.
  virtual void fill_layer(std::size_t layer, Quantity quantity, std::size_t row,
                          std::span<float> values) const = 0;
  /// Numbers of layers; 0 unless they were asked for.
  virtual std::size_t bounce_layers() const = 0;
  virtual std::size_t length_layers() const = 0;
};

/// `write_signal_file` (signal_file.hpp) without the rename: the caller commits.
void write_signal_file(const SignalMatrix& matrix, AtomicFile& target);

/// The same with the entries from elsewhere, a few rows at a time; those of `head` are not used.
void write_signal_file(const SignalMatrix& head, const SignalRows& rows, const std::filesystem::path& path);

}  // namespace shelfbeam
