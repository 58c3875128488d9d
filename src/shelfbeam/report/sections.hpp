#pragma once

#include <string>

#include "shelfbeam/report/maps.hpp"
#include "shelfbeam/report/report_data.hpp"

namespace shelfbeam {

// The parts of the page, in its order. Each returns HTML; empty where there is nothing to say.

std::string answer_section(const ReportData& data);
std::string key_figures(const ReportData& data);
/// Labels that no selection reaches: what they need and the most they could get.
std::string unreachable_section(const ReportData& data);
std::string margin_section(const ReportData& data, const Maps& maps);
std::string reflection_section(const ReportData& data, const Maps& maps);
std::string distribution_section(const ReportData& data);
std::string unit_section(const ReportData& data);
std::string weakest_section(const ReportData& data);
std::string facts_section(const ReportData& data);

}  // namespace shelfbeam
