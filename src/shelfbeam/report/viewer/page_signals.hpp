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

/// The rounding of entries in large pages; by default entries are not rounded.
struct Rounding {
  std::uint32_t grains_per_requirement = 0;  ///< grains per requirement; 0: entries are not rounded
  double details_from = 0;           ///< share of the requirement above which error and direct share are kept
  double error_ratio = 1;            ///< minimum ratio of neighbouring codes of standard errors
  double direct_step = 1.0 / 65535;  ///< step of the direct shares
};

/// The entries of a signal matrix in a page, row by row in the order of the columns, without entries that are
/// not above 0.
///
/// If the page would be too large, entries are rounded by a grain of 1 / n of the label's requirement: an
/// entry between k and k + 1 grains becomes k + 1/2 grains. Entries below one grain are omitted, except the
/// two largest of the chosen units of every label. n is an integer, so no entry crosses the requirement.
struct PageSignals {
  std::vector<std::uint32_t> row_size;  ///< entries of each label
  std::vector<std::uint32_t> gap;       ///< columns since the previous entry; first in a row: its column
  std::vector<float> mean;              ///< after rounding, as in the script of the page
  std::vector<std::uint32_t> grains;    ///< k of each entry; empty without rounding
  /// Code of the standard error, accurate to half a step: 0 for none, otherwise min_error exp((code - 1)
  /// error_step), for rounded entries times the mean. Empty without errors.
  std::vector<std::uint16_t> error;
  std::vector<std::uint16_t> direct;  ///< direct / mean in direct_step; empty without direct signals
  double grain = 0;                   ///< share of the requirement; 0: no entry is rounded or omitted
  std::uint32_t details_from = 0;     ///< grains; smaller entries have neither error nor direct share
  double min_error = 1, error_step = 0, direct_step = 1;

  /// The page contains the standard error and direct share of the entry.
  bool is_detailed(std::size_t entry) const { return grains.empty() || grains[entry] >= details_from; }

  std::size_t omitted = 0;  ///< omitted entries above 0
  /// Maximum error of one entry and of the sum over one label, as a share of its requirement; that label.
  double largest_error = 0, largest_effect = 0;
  std::uint32_t max_affected = 0;
  /// With rounding, per label: received_signal of the plan minus the signal from the rounded entries.
  /// Otherwise empty.
  std::vector<double> rest;
};

PageSignals page_signals(const SignalMatrix& matrix, const Placement& placement,
                         const Rounding& rounding = {});

/// Signals in base64 (PageData) with the finest grain that fits `max_bytes`, or the coarsest if none fits.
/// With grains above 1 %, only entries from relevant_share on keep errors and direct shares.
struct PackedSignals {
  PageSignals signals;
  std::string base64;
};
PackedSignals pack_signals(const SignalMatrix& matrix, const Placement& placement, std::size_t max_bytes);

/// The store for the 3-D view in base64 (PageData): room, parts of fixtures, labels, candidates, placement
/// problem, placement, and states of a shop that changes. Positions are in m in single precision,
/// requirements in double precision.
std::string pack_store(const ReportData& data, const SignalScale& scale);

}  // namespace shelfbeam
