#pragma once

#include "shelfbeam/placement/io/placement_json.hpp"
#include "shelfbeam/plan/answer/availability.hpp"

namespace shelfbeam::detail {

/// The key "states" of placement.json (docs/formats/placement.md).
Json availability_object(const Availability& availability, const SignalTable& table);
Availability read_availability(const JsonCursor& object, const SignalTable& table);

}  // namespace shelfbeam::detail
