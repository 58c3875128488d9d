#pragma once

#include <string>

#include "shelfbeam/report/chart/palette.hpp"
#include "shelfbeam/report/data/report_data.hpp"

namespace shelfbeam {

/// What the 3-D view draws and names, in base64 (PageData): room, parts of fixtures, labels, candidates, the
/// question and its answer. Positions are in m and in single precision, requirements as they are.
std::string pack_store(const ReportData& data, const SignalScale& scale);

}  // namespace shelfbeam
