#pragma once

#include <string_view>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

// A new shop: the files store.json and catalogue.json.
std::string_view starter_store();
std::string_view starter_catalogue();

/// The values on which a plan for the scene rests most, and how well each is known. Of materials, those of at
/// least 5 % of all surfaces count.
std::vector<DecisiveValue> decisive_values(const Store& store, const Scene& scene);

}  // namespace shelfbeam
