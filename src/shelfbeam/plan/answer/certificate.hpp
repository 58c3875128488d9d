#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

enum class Verdict {
  reached,   ///< the lower limit meets the requirement
  missed,    ///< the upper limit does not
  undecided  ///< the requirement lies between
};

template <>
inline constexpr auto names_of<Verdict> = std::to_array<Named<Verdict>>({{"reached", Verdict::reached},
                                                                         {"missed", Verdict::missed},
                                                                         {"undecided", Verdict::undecided}});

/// What fresh samples say of one label at a placement. The signal is what the question counts
/// (received_signal): the sum, or the link that was planned for the label; where a unit may fail what is left
/// in the worst case.
struct LabelVerdict {
  Verdict verdict = Verdict::undecided;
  double requirement = 0;  ///< gamma tau
  double signal = 0;
  double standard_error = 0;
  double lower = 0, upper = 0;  ///< one-sided limits at the level of one statement
  std::uint64_t samples = 0;    ///< first rays
};

/// What can be said of a placement with a joint confidence, as far as sampling errors go: for the given
/// geometry, materials and candidates.
struct Certificate {
  double confidence = 0.99;
  std::vector<LabelVerdict> labels;   ///< one a label of the matrix
  std::size_t count_lower_bound = 0;  ///< no fewer units reach all labels; 0: not examined
  std::size_t bound_labels = 0;       ///< labels on whose fresh signals that rests
  std::uint32_t rounds = 0;
  double seconds = 0;
  std::string open;  ///< why it ended before all was decided; empty otherwise

  std::size_t count(Verdict verdict) const {
    const auto has = [&](const LabelVerdict& label) { return label.verdict == verdict; };
    return static_cast<std::size_t>(std::count_if(labels.begin(), labels.end(), has));
  }
  bool all_reached() const { return count(Verdict::reached) == labels.size(); }
};

}  // namespace shelfbeam
