#pragma once

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/report/messages/difference.hpp"

namespace shelfbeam {

/// The difference as JSON (docs/formats/difference.md).
nlohmann::ordered_json difference_json(const DifferenceInput& input);

}  // namespace shelfbeam
