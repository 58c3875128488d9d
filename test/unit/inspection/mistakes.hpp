#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace shelfbeam::test {

using Json = nlohmann::ordered_json;

/// The store of a shop with one mistake.
struct Mistake {
  std::string name;
  std::function<void(Json&)> make;  ///< puts the mistake into the good store
};

/// The good store: a small shop with meshes, glass, two types of units and a list of labels. Its files are in
/// the folder of examples/chiller.
Json good_store();

/// Mistakes of the kinds for which checks were written.
std::vector<Mistake> expected_mistakes();

/// Mistakes of other kinds, written down before any check of plausibility existed.
std::vector<Mistake> other_mistakes();

/// Changes after which the store is unusual, but plausible.
std::vector<Mistake> plausible_changes();

}  // namespace shelfbeam::test
