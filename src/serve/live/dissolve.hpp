#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/build/draft.hpp"
#include "shelfbeam/scene/store/completed_fixture.hpp"

#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

/// The edit that replaces an entry of "fixtures" with `repeat` or `against` by fixtures that have places of
/// their own, each with the id and the place that it has now. `whole`: the entry with the keys of its
/// presets, which take its place if one of them has these keys. The first one keeps the comments of the
/// entry. Throws InputError if the entry has neither, or has problems.
std::vector<EditOp> dissolved(const std::string& pointer, const nlohmann::ordered_json& entry,
                              const FixtureKeys& whole, const Draft& draft);

}  // namespace shelfbeam::serve
