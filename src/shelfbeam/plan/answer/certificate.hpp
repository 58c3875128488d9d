#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "shelfbeam/base/names.hpp"
#include "shelfbeam/plan/answer/end_reason.hpp"

namespace shelfbeam {

enum class Verdict {
  reached,    ///< lower limit at least the requirement
  missed,     ///< upper limit below the requirement
  undecided,  ///< requirement between the limits
  unverified  ///< no samples yet
};

template <>
inline constexpr auto names_of<Verdict> =
    std::to_array<Named<Verdict>>({{"reached", Verdict::reached},
                                   {"missed", Verdict::missed},
                                   {"undecided", Verdict::undecided},
                                   {"not verified yet", Verdict::unverified}});

/// Whether the samples decide the label.
inline bool is_decided(Verdict verdict) {
  return verdict == Verdict::reached || verdict == Verdict::missed;
}

/// The result of independent samples for one label. The signal is that of received_signal: the sum, or the
/// link planned for the label; with unit failure, after the worst failure.
struct LabelVerdict {
  Verdict verdict = Verdict::undecided;
  double requirement = 0;  ///< gamma tau
  double signal = 0;
  double standard_error = 0;
  /// One-sided limits: at the label's share of the level if its verdict is one of a list; if all labels are
  /// certified by one joint statement, the lower limit is at the level of this statement.
  double lower = 0, upper = 0;
  double joint_lower = 0;  ///< lower limit at the level of the joint statement that all labels are reached
  std::uint64_t samples = 0;
};

/// Statements about a placement that hold together with a given confidence. They cover sampling errors only,
/// for the given geometry, materials and candidates.
struct Certificate {
  double confidence = 0.99;
  std::vector<LabelVerdict> labels;  ///< one per label of the matrix
  /// Certified bounds on the count, and on the cost where has_known_prices; 0: not examined, or no selection.
  /// At most the value of a selection all of whose labels are reached; independent of the bounds on the
  /// matrix, which may be lower or higher.
  std::size_t count_lower_bound = 0;
  double cost_lower_bound = 0;
  std::size_t bound_labels = 0;  ///< number of core rows behind the bound; 0: it needs no samples
  std::uint32_t rounds = 0;
  double seconds = 0;
  std::optional<EndReason> open = {};  ///< reason for an end before all was decided

  std::size_t count(Verdict verdict) const {
    const auto has = [&](const LabelVerdict& label) { return label.verdict == verdict; };
    return static_cast<std::size_t>(std::count_if(labels.begin(), labels.end(), has));
  }
  /// Open labels without samples become unverified.
  void mark_unverified() {
    for (LabelVerdict& label : labels)
      if (label.verdict == Verdict::undecided && label.samples == 0) label.verdict = Verdict::unverified;
  }
  /// Lowers the bounds to those of a selection. Without units nothing is bounded.
  void limit_bounds(std::size_t units, double cost) {
    count_lower_bound = std::min(count_lower_bound, units);
    cost_lower_bound = units == 0 ? 0 : std::min(cost_lower_bound, cost);
    if (count_lower_bound == 0 && cost_lower_bound == 0) bound_labels = 0;
  }
  bool none_verified() const { return count(Verdict::unverified) == labels.size(); }
  bool all_reached() const { return count(Verdict::reached) == labels.size(); }
};

}  // namespace shelfbeam
