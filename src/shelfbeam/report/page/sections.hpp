#pragma once

#include <string>
#include <string_view>

#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/drawing/maps.hpp"

namespace shelfbeam {

// The sections of the page, in its order. Each returns HTML, or an empty string if it does not apply.

/// The first page, for a manager.
std::string summary_section(const ReportData& data, const Maps& maps);
/// The second page, for a fitter; empty without a selection.
std::string mounting_section(const ReportData& data, const Maps& maps);
std::string warning_section(const ReportData& data);
/// Labels that no selection reaches, with requirement and maximum signal.
std::string unreachable_section(const ReportData& data);
/// The bundle of src/page/report; empty in a build without Node.js or its packages.
std::string_view viewer_script();
/// The 3-D view with its data and script; with an empty script, a note that the view is missing.
std::string viewer_section(const ReportData& data, std::string_view script);
/// Maximum size of the signals in the 3-D view, in bytes.
inline constexpr std::size_t max_signal_bytes = 20'000'000;
std::string margin_section(const ReportData& data, const Maps& maps);
std::string reflection_section(const ReportData& data, const Maps& maps);
/// The effect of reflectance ranges on the placement; empty without a sensitivity analysis.
std::string sensitivity_section(const ReportData& data);
/// Plans for a shop that changes, and the labels at risk; empty for a plan without states.
std::string availability_section(const ReportData& data);
std::string distribution_section(const ReportData& data);
std::string unit_section(const ReportData& data, const Maps& maps);
/// The coverage curve; empty without one.
std::string curve_section(const ReportData& data);
std::string weakest_section(const ReportData& data);
/// Per fixture, its labels by board and the weakest of them.
std::string fixture_section(const ReportData& data);
std::string facts_section(const ReportData& data);

}  // namespace shelfbeam
