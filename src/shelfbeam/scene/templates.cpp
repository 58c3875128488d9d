#include "shelfbeam/scene/templates.hpp"

#include <array>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

// Made by cmake/embed.cmake from the files in examples/.
namespace embedded {
extern const std::string_view thesis_store;
extern const std::string_view grocery_store;
extern const std::string_view grocery_checkout;
}  // namespace embedded

std::span<const StoreTemplate> store_templates() {
  static const std::array thesis{TemplateFile{"store.json", embedded::thesis_store}};
  static const std::array grocery{TemplateFile{"store.json", embedded::grocery_store},
                                  TemplateFile{"checkout.glb", embedded::grocery_checkout}};
  static const std::array templates{
      StoreTemplate{"thesis", "the test environment of the paper: 390 labels, 320 candidates", thesis},
      StoreTemplate{"grocery", "a small grocery with gondolas, freezers and checkouts", grocery}};
  return templates;
}

const StoreTemplate& find_template(const std::string& name) {
  std::vector<std::string_view> known;
  for (const StoreTemplate& t : store_templates()) {
    if (t.name == name) return t;
    known.push_back(t.name);
  }
  throw InputError("TEMPLATE", fmt::format("there is no template '{}'", name), suggest(name, known));
}

}  // namespace shelfbeam
