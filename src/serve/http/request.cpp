#include "serve/http/request.hpp"

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

}  // namespace shelfbeam::serve::http
