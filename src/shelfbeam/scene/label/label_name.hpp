#pragma once

#include <string>
#include <string_view>

namespace shelfbeam {

/// A label in a sentence: "'Rye bread' (4001686301265)", and "'4001686301265'" without a description.
std::string label_name(std::string_view id, std::string_view description);

}  // namespace shelfbeam
