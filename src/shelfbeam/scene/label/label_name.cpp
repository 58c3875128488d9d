#include "shelfbeam/scene/label/label_name.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

std::string label_name(std::string_view id, std::string_view description) {
  constexpr std::size_t longest = 60;
  return description.empty() ? in_quotes(id)
                             : fmt::format("{} ({})", in_quotes(description), shortened(id, longest));
}

}  // namespace shelfbeam
