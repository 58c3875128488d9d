#pragma once

#include <cstddef>
#include <span>

namespace shelfbeam {

/// The entries of a signal matrix, row by row when they are asked for: for matrices that are held in another
/// form.
class SignalRows {
 public:
  enum class Quantity { mean, standard_error, direct };

  virtual ~SignalRows() = default;
  /// Fills `values`, one a column.
  virtual void fill(Quantity quantity, std::size_t row, std::span<float> values) const = 0;
  /// The same of the part that comes over so many bounces; has no direct part.
  virtual void fill_layer(std::size_t bounces, Quantity quantity, std::size_t row,
                          std::span<float> values) const = 0;
  /// Number of such parts; 0 unless they were asked for.
  virtual std::size_t layers() const = 0;
};

}  // namespace shelfbeam
