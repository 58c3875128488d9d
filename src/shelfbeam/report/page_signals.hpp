#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/placement/placement.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// The entries of a signal matrix that a page carries, row by row in the order of the columns. Means are as
/// they are in the matrix; entries without signal are not there.
struct PageSignals {
  std::vector<std::uint32_t> row_size;  ///< entries of each label
  std::vector<std::uint32_t> gap;       ///< columns since the entry before; of a row's first, its column
  std::vector<float> mean;
  std::vector<std::uint16_t> error;   ///< code of the standard error (error_of); empty where it is not known
  std::vector<std::uint16_t> direct;  ///< direct / mean in 1/65535; empty where it is not known
  double least_error = 1, error_step = 0;

  /// 0 for code 0, else least_error exp((code - 1) error_step): up to half a step off.
  double error_of(std::uint16_t code) const;

  std::size_t left_out = 0;     ///< entries with signal that are not here
  double largest_left_out = 0;  ///< the largest of them, as a share of what its label needs
  /// The most that those of one label come to together, as a share of what it needs, and that label.
  double largest_effect = 0;
  std::uint32_t most_affected = 0;
  /// Where entries are left out: what to add to the sum of the chosen units' entries that are here, so that
  /// it is their whole sum, as received_signal counts it. Else empty.
  std::vector<double> rest;
};

/// All entries, or where that are more than `most`, the largest in proportion to what their labels need: so
/// many at most, apart from the two largest of the chosen units of every label, which are always kept.
PageSignals page_signals(const SignalMatrix& matrix, const Placement& placement, std::size_t most);

/// In base64 (PageData), where necessary with entries left out so that it is `most_bytes` long at most.
struct PackedSignals {
  PageSignals signals;
  std::string base64;
};
PackedSignals pack_signals(const SignalMatrix& matrix, const Placement& placement, std::size_t most_bytes);

}  // namespace shelfbeam
