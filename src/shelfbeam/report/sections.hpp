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
/// The 3-D view with its data and its script; in a build without it a word that it was left out.
std::string viewer_section(const ReportData& data);
bool has_viewer();
/// The signals in it take so many bytes at most.
inline constexpr std::size_t most_signal_bytes = 20'000'000;
std::string margin_section(const ReportData& data, const Maps& maps);
std::string reflection_section(const ReportData& data, const Maps& maps);
/// What ranges of reflectances do to the placement; empty where that was not asked for.
std::string sensitivity_section(const ReportData& data);
std::string distribution_section(const ReportData& data);
std::string unit_section(const ReportData& data);
/// What fewer units reach; empty where that was not asked for.
std::string curve_section(const ReportData& data);
std::string weakest_section(const ReportData& data);
std::string facts_section(const ReportData& data);

}  // namespace shelfbeam
