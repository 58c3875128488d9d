#include "serve/http/request.hpp"

#include <algorithm>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam::serve::http {

std::vector<std::string_view> Request::values(std::string_view name) const {
  std::vector<std::string_view> found;
  for (const auto& [own, value] : fields)
    if (own.size() == name.size() && lower_case(own) == name) found.push_back(value);
  return found;
}

bool Request::lists(std::string_view name, std::string_view item) const {
  for (const std::string_view value : values(name))
    for (const std::string_view part : split(value, ','))
      if (lower_case(part) == item) return true;
  return false;
}

bool Request::accepts_gzip() const {
  for (const std::string_view value : values("accept-encoding")) {
    for (const std::string_view part : split(value, ',')) {
      const std::vector<std::string_view> pieces = split(part, ';');
      if (lower_case(pieces[0]) != "gzip") continue;
      // "q=0", "q=0.0", "q=0.00" and "q=0.000" refuse it.
      return std::ranges::none_of(pieces, [](std::string_view piece) {
        return lower_case(piece).starts_with("q=0") &&
               piece.find_first_not_of("0.", 2) == std::string_view::npos;
      });
    }
  }
  return false;
}

}  // namespace shelfbeam::serve::http
