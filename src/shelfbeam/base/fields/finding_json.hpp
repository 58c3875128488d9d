#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/base/finding/finding.hpp"

namespace shelfbeam {

class JsonCursor;

/// Objects with `code`, `path`, `values` and `sentence`.
nlohmann::ordered_json to_json(const std::vector<Finding>& findings);

/// Texts, as earlier versions of the program wrote them, become findings with the code `other`. Throws
/// nlohmann::json::exception.
std::vector<Finding> findings_of(const nlohmann::ordered_json& list);
/// Throws InputError.
std::vector<Finding> read_findings(const JsonCursor& list);

}  // namespace shelfbeam
