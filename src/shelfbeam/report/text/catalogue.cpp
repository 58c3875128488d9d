#include "shelfbeam/report/text/catalogue.hpp"

#include <map>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace shelfbeam {

namespace embedded {
extern const std::string_view report_text;
}  // namespace embedded

namespace {

using Catalogue = std::map<std::string, std::string, std::less<>>;

void collect(const nlohmann::json& node, const std::string& path, Catalogue& catalogue) {
  for (const auto& [name, value] : node.items()) {
    const std::string key = path.empty() ? name : fmt::format("{}.{}", path, name);
    if (value.is_string())
      catalogue.emplace(key, value.get<std::string>());
    else
      collect(value, key, catalogue);
  }
}

Catalogue read_catalogue() {
  Catalogue catalogue;
  collect(nlohmann::json::parse(embedded::report_text), "", catalogue);
  return catalogue;
}

}  // namespace

std::string_view words(std::string_view key) {
  static const Catalogue catalogue = read_catalogue();
  const auto found = catalogue.find(key);
  if (found == catalogue.end()) throw std::logic_error(fmt::format("the text catalogue has no '{}'", key));
  return found->second;
}

}  // namespace shelfbeam
