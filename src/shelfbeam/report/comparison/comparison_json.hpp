#pragma once

#include <cstddef>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/report/comparison/comparison_report.hpp"

namespace shelfbeam {

/// A comparison with all outliers, and the `listed` worst of the other pairs (docs/formats/measurements.md).
nlohmann::ordered_json comparison_json(const ComparisonInput& input, std::size_t listed);

}  // namespace shelfbeam
