#include "serve/text/json_pointer.hpp"

namespace shelfbeam::serve {

std::optional<std::vector<std::string>> pointer_steps(std::string_view pointer) {
  std::vector<std::string> steps;
  if (!pointer.empty() && pointer.front() != '/') return std::nullopt;
  for (std::size_t at = 0; at < pointer.size(); ++at) {
    if (pointer[at] == '/') {
      steps.emplace_back();
    } else if (pointer[at] != '~') {
      steps.back() += pointer[at];
    } else {
      const std::string_view escaped = pointer.substr(++at, 1);
      if (escaped != "0" && escaped != "1") return std::nullopt;
      steps.back() += escaped == "0" ? '~' : '/';
    }
  }
  return steps;
}

}  // namespace shelfbeam::serve
