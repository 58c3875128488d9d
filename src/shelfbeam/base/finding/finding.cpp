#include "shelfbeam/base/finding/finding.hpp"

#include <array>

namespace shelfbeam {

std::string_view name_of(FindingCode code) {
  constexpr auto names = std::to_array<std::string_view>(
      {"invalid", "wrong_kind", "missing_key", "unknown_key", "outside_limits", "unknown_name"});
  return names[static_cast<std::size_t>(code)];
}

}  // namespace shelfbeam
