#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <unordered_map>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/build/draft.hpp"

namespace shelfbeam::serve {

/// The indices of labels in a draft, by their ids.
class LabelNumbers {
 public:
  explicit LabelNumbers(const Draft& draft);
  /// Of those in a list of ids that the draft has.
  nlohmann::ordered_json of(const nlohmann::ordered_json& ids) const;
  /// The same, each with its id: `[index, id]`.
  nlohmann::ordered_json with_ids(const nlohmann::ordered_json& ids) const;

 private:
  std::unordered_map<std::string, std::size_t> numbers_;
};

/// The states of a plan for a changing shop, for a page: `shown`, the states that its report shows, each with
/// its number `state`, the indices of the labels that it misses, the outlines (m) of people and objects, and
/// the ids of fixtures whose doors are open; and `availability`, by label of the draft, the share of the
/// fresh states in which it is reached, or null. `placement`: the placement.json in `folder`. Throws
/// InputError if the store in the folder cannot be read.
nlohmann::ordered_json states_of_plan(const std::filesystem::path& folder,
                                      const nlohmann::ordered_json& placement, const Draft& draft);

}  // namespace shelfbeam::serve
