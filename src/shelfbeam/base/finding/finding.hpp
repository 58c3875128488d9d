#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace shelfbeam {

/// What is wrong with a part of a store.
enum class FindingCode : std::uint8_t {
  invalid,
  wrong_kind,
  missing_key,
  unknown_key,
  outside_limits,
  unknown_name,
};
/// Its name in files.
std::string_view name_of(FindingCode code);

/// A number or a name in the sentence of a finding: "value", "least", "name".
struct FindingValue {
  std::string_view name;
  std::variant<double, std::string> value;
};
using FindingValues = std::vector<FindingValue>;

/// A problem of a store, or a warning about it.
struct Finding {
  FindingCode code = FindingCode::invalid;
  std::string path;  ///< of the element in the store file ("fixtures[3].depth"), or the line of a CSV file
  FindingValues values;
  std::string sentence;  ///< with the name of the file
};

}  // namespace shelfbeam
