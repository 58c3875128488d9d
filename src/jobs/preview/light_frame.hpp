#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/names.hpp"
#include "shelfbeam/transport/operator/preview.hpp"

namespace shelfbeam::jobs {

// Binary messages of the planner's protocol (docs/formats/planner.md#light).

/// How the values of a unit were computed, from the worst to the best.
enum class LightStage : std::uint8_t { direct, coarse, fine, simulated };

}  // namespace shelfbeam::jobs

namespace shelfbeam {

template <>
inline constexpr auto names_of<jobs::LightStage> =
    std::to_array<Named<jobs::LightStage>>({{"direct", jobs::LightStage::direct},
                                            {"coarse", jobs::LightStage::coarse},
                                            {"fine", jobs::LightStage::fine},
                                            {"simulated", jobs::LightStage::simulated}});

}  // namespace shelfbeam

namespace shelfbeam::jobs {

/// The key of a unit in messages.
std::string unit_key(std::uint64_t light_key);

/// `about`: the header of a message; `column`: its arrays `signal`, `error` and `doubts`, all by label.
std::string column_frame(const nlohmann::ordered_json& about, const Preview& column);

/// The header of a message. Throws nlohmann::json::exception or std::out_of_range for other bytes.
nlohmann::ordered_json about_of(std::string_view frame);

/// The column of a message, for programs of the same version. Throws as about_of.
Preview column_of(std::string_view frame);

}  // namespace shelfbeam::jobs
