#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// A measured signal with its label and transceiver.
struct Measurement {
  LabelId label;                        ///< row of the matrix
  std::optional<ColumnId> transceiver;  ///< column; nothing: several units at once
  double signal = 0;                    ///< linear, in any unit of measure; may be 0 or negative
  std::optional<double> error;          ///< standard deviation of `signal`, above 0
};

/// Measured signals: either all from single transceivers or all from several at once.
struct Measurements {
  std::vector<Measurement> values;
  bool of_pairs = false;  ///< whether the file names transceivers
  bool has_errors = false;
};

/// Reads a CSV with header `label,transceiver,signal,error` (docs/formats/measurements.md); `transceiver` and
/// `error` may be missing, and the order is free. Throws InputError with file and line for another header,
/// unknown ids, duplicate labels or pairs, values that are not finite, and errors that are not above 0.
Measurements read_measurements(const std::filesystem::path& path, const SignalMatrix& matrix);

}  // namespace shelfbeam
