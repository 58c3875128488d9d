#pragma once

#include <span>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/base/decisive_value.hpp"
#include "shelfbeam/base/length_unit.hpp"

namespace shelfbeam {

class JsonCursor;
class Problems;

// The sections "confirmed" and "assumed" of a store file (docs/formats/store/values.md). They hold values by
// the places that these have in the file, and have no effect once the values there are others.

/// Collects the problems of a section.
std::vector<DecisiveValue> read_marks(const JsonCursor& section, ValueState state, Problems& problems);

/// The JSON pointer of the mark of a value, below "confirmed" or "assumed".
std::string mark_pointer(const DecisiveValue& value);
/// The value of its mark, in a store with this unit of length.
nlohmann::ordered_json mark_json(const DecisiveValue& value, LengthUnit unit);
/// The value with its state, and the place and value of its mark.
nlohmann::ordered_json to_json(const DecisiveValue& value, LengthUnit unit);
/// The section that holds all values with this state, in m; null if there are none.
nlohmann::ordered_json marks_section(std::span<const DecisiveValue> values, ValueState state);

/// Whether two values of marks are the same, up to a rounding of their numbers by one part in a million.
bool same_value(std::string_view one, std::string_view other);

}  // namespace shelfbeam
