#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/plan/preview/what_if.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The answer of a preview, one sentence.
std::string preview_answer(const WhatIf& what_if);
/// The remarks on it, one per line.
std::string preview_remarks(const WhatIf& what_if, const Scene& scene);
/// The weakest labels, with a heading; empty without labels.
std::vector<std::vector<std::string>> preview_table(const WhatIf& what_if, const Scene& scene,
                                                    std::size_t most);
/// All labels (docs/formats/preview.md).
nlohmann::ordered_json preview_json(const WhatIf& what_if, const Scene& scene);

}  // namespace shelfbeam
