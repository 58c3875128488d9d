#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

// Sentences about plans whose value, a count or a cost, may be larger than necessary.

/// "All 926 labels are certified, so the plan can be mounted as it is; whether fewer transceivers are enough
/// is open: 8 to 11." Empty if nothing is open, if a label is missed or undecided, and for a shop that
/// changes. Counts are those of new units if some of the selection are `installed`.
std::string open_bound(const Words& words, const CertifiedPlan& plan, std::size_t installed = 0);

/// An advice without a full stop, and the settings that it is about.
struct Remedy {
  std::string advice;  ///< "A longer search may decide this"; empty: there is none
  std::vector<Setting> settings;

  /// A sentence, followed by the advice if there is one.
  std::string after(const std::string& sentence) const {
    return advice.empty() ? sentence : sentence + (sentence.empty() ? "" : " ") + advice + ".";
  }
};

/// The remedy for an open bound or, if labels are missed or undecided, for the end of their certificate.
Remedy remedy_for(const Words& words, const CertifiedPlan& plan);

}  // namespace shelfbeam
