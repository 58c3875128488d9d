#pragma once

#include <string>

#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// The sentences of the first page about the minimum of a selection, and about the statements that
/// independent samples confirm. The confidence belongs to the second remark; the first names simulated
/// signals where nothing else proves it.
struct ProofRemarks {
  std::string
      bound;  ///< "Fewer are not enough."; empty if no bound is known, or if nothing has to be mounted
  std::string confirmation;
};

/// Precondition: there is a selection, and the shop does not change.
ProofRemarks proof_remarks(const ReportData& data);

/// The number of chosen units that are not installed yet.
std::size_t new_units(const ReportData& data);

/// `text` on one line.
std::string joined(std::string text);

/// "99 %", on one line.
std::string confidence_percent(const Words& words, double confidence);

}  // namespace shelfbeam
