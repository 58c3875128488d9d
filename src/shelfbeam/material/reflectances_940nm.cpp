#include "shelfbeam/material/reflectances_940nm.hpp"

#include <string_view>

#include "shelfbeam/base/json.hpp"

namespace shelfbeam {

// Made by cmake/embed.cmake from the file in data/.
namespace embedded {
extern const std::string_view materials_940nm;
}

const std::vector<NamedReflectance>& reflectances_940nm() {
  static const auto all = [] {
    std::vector<NamedReflectance> list;
    const JsonCursor root = JsonCursor::parse(embedded::materials_940nm, "materials_940nm.json");
    for (const auto& [name, entry] : root["reflectances"].members()) {
      list.push_back({name, entry["reflectance"].number(0, 1), {}});
      if (const auto range = entry.find("range")) {
        const std::vector<double> ends = range->numbers(2);
        list.back().range = {ends[0], ends[1]};
      }
    }
    return list;
  }();
  return all;
}

}  // namespace shelfbeam
