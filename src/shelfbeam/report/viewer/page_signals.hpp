#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/report/chart/palette.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// How entries are rounded where all of them would be too many; by default they are not.
struct Rounding {
  std::uint32_t grains_a_need = 0;   ///< grains in what a label needs; 0: entries stay as they are
  double details_from = 0;           ///< share of it from which on standard error and direct share are kept
  double error_ratio = 1;            ///< of neighbouring standard errors, at least
  double direct_step = 1.0 / 65535;  ///< of direct shares
};

/// The entries of a signal matrix that a page carries, row by row in the order of the columns. Entries
/// without signal are not there.
///
/// Where all of them would be too many they are rounded by a grain, a share 1 / n of what the label needs: an
/// entry between k and k + 1 grains is in the middle, what is below one grain is left out, but for the two
/// largest of the chosen units of every label. As n is an integer, no entry crosses what the label needs.
struct PageSignals {
  std::vector<std::uint32_t> row_size;  ///< entries of each label
  std::vector<std::uint32_t> gap;       ///< columns since the entry before; of a row's first, its column
  std::vector<float> mean;              ///< as the page's script has it
  std::vector<std::uint32_t> grains;    ///< k of each entry; empty where means are as they are in the matrix
  std::vector<std::uint32_t> negative;  ///< rounded entries below 0, as noise may have it
  /// Code of the standard error, up to half a step off: 0 for none, else least_error exp((code - 1)
  /// error_step), of rounded entries times the mean's size. Empty where errors are not known.
  std::vector<std::uint16_t> error;
  std::vector<std::uint16_t> direct;  ///< direct / mean in direct_step; empty where it is not known
  double grain = 0;                   ///< as a share of what a label needs; 0: nothing is rounded or left out
  std::uint32_t details_from = 0;     ///< grains; of smaller entries error and direct share are not kept
  double least_error = 1, error_step = 0, direct_step = 1;

  /// Its standard error and direct share are kept.
  bool is_detailed(std::size_t entry) const { return grains.empty() || grains[entry] >= details_from; }

  std::size_t left_out = 0;  ///< entries with signal that are not here
  /// The most that an entry is off, and those of one label together, as a share of what it needs; that label.
  double largest_error = 0, largest_effect = 0;
  std::uint32_t most_affected = 0;
  /// Where entries are rounded: what to add to the signal from the chosen units' entries that are here, so
  /// that it is what received_signal counts. Else empty.
  std::vector<double> rest;
};

PageSignals page_signals(const SignalMatrix& matrix, const Placement& placement,
                         const Rounding& rounding = {});

/// In base64 (PageData), `most_bytes` long at most, with the finest grain for which that is so (the coarsest
/// where none is). Where that is above 1 %, only the entries that matter keep errors and direct shares.
struct PackedSignals {
  PageSignals signals;
  std::string base64;
};
PackedSignals pack_signals(const SignalMatrix& matrix, const Placement& placement, std::size_t most_bytes);

/// What the 3-D view draws and names, in base64 (PageData): room, parts of fixtures, labels, candidates, the
/// question and its answer. Positions are in m and in single precision, requirements as they are.
std::string pack_store(const ReportData& data, const SignalScale& scale);

}  // namespace shelfbeam
