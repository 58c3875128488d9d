#pragma once

#include <string>
#include <vector>

#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/transport/world/coverage.hpp"

namespace shelfbeam {

/// "light from disc transceivers refracted by solid glass (bottle)"
std::vector<std::string> light_texts(const Words& words, const std::vector<LightKind>& kinds,
                                     const Scene& scene);

}  // namespace shelfbeam
