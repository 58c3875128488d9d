#pragma once

#include <nlohmann/json.hpp>

#include "shelfbeam/device/device_types.hpp"

namespace shelfbeam {

/// Types as the resolved store writes them: nothing left to look up, and read back the same to the bit.
nlohmann::ordered_json resolved(const LabelType& type);
nlohmann::ordered_json resolved(const TransceiverType& type);

}  // namespace shelfbeam
