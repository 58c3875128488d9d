#pragma once

#include <string>
#include <string_view>

#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/drawing/maps.hpp"

namespace shelfbeam {

// The parts of the page, in its order. Each returns HTML; empty where there is nothing to say.

std::string answer_section(const ReportData& data);
std::string key_figures(const ReportData& data);
/// Labels that no selection reaches: what they need and the most they could get.
std::string unreachable_section(const ReportData& data);
/// The bundle of src/viewer; empty in a build without Node.js or its packages.
std::string_view viewer_script();
/// The 3-D view with its data and its script; where that is empty a word that the view was left out.
std::string viewer_section(const ReportData& data, std::string_view script);
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
