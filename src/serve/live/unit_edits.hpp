#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/build/draft.hpp"

#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

/// What an action makes of the lists of units (docs/formats/planner.md#units).
struct UnitEdit {
  std::vector<EditOp> ops;
  std::vector<std::string> ids;  ///< of the units afterwards
};

/// `request`: the keys of the action, or a list `each` of such requests. Throws InputError if it does not fit
/// the store.
UnitEdit unit_edit(const nlohmann::ordered_json& request, const nlohmann::ordered_json& store,
                   const Draft& draft);

/// The unit of a draft with this number: the candidates, then the excluded ones. Throws InputError.
const Transceiver& unit_numbered(const Draft& draft, std::size_t index);

/// A unit with the values that a request gives: `type`, `axis`, `roll_deg`, `power`.
void change_unit(const nlohmann::ordered_json& request, const Draft& draft, Transceiver& unit);

}  // namespace shelfbeam::serve
