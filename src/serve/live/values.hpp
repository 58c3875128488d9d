#pragma once

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/build/draft.hpp"

namespace shelfbeam::serve {

/// The values on which a plan of the shop rests, the most influential first, with their states, words, and
/// the places and values of their marks below "confirmed" (docs/formats/planner.md); empty while the shop has
/// problems.
nlohmann::ordered_json values_of(const Draft& draft);

/// The types of labels and transceivers in the catalogues of the store, of which its types can be made.
nlohmann::ordered_json products_of(const Draft& draft);

}  // namespace shelfbeam::serve
