#include "shelfbeam/scene/build/templates.hpp"

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
extern const std::string_view chiller_store;
extern const std::string_view chiller_till;
extern const std::string_view chiller_mirror;
extern const std::string_view chiller_ring;
extern const std::string_view chiller_spot;
extern const std::string_view supermarket_store;
extern const std::string_view hypermarket_store;
}  // namespace embedded

std::span<const StoreTemplate> store_templates() {
  static const std::array thesis{TemplateFile{"store.json", embedded::thesis_store}};
  static const std::array grocery{TemplateFile{"store.json", embedded::grocery_store},
                                  TemplateFile{"checkout.glb", embedded::grocery_checkout}};
  static const std::array chiller{TemplateFile{"store.json", embedded::chiller_store},
                                  TemplateFile{"till.glb", embedded::chiller_till},
                                  TemplateFile{"security-mirror.obj", embedded::chiller_mirror},
                                  TemplateFile{"batwing.ies", embedded::chiller_ring},
                                  TemplateFile{"narrow-aisle.ldt", embedded::chiller_spot}};
  static const std::array supermarket{TemplateFile{"store.json", embedded::supermarket_store}};
  static const std::array hypermarket{TemplateFile{"store.json", embedded::hypermarket_store}};
  static const std::array templates{
      StoreTemplate{"thesis", "the test environment of the paper: 390 labels, 320 candidates", thesis},
      StoreTemplate{"grocery", "a small grocery with gondolas, freezers and checkouts", grocery},
      StoreTemplate{"chiller", "a station shop: glass doors, measured profiles, several ways to aim a unit",
                    chiller},
      StoreTemplate{"supermarket", "50 x 40 m: 5,000 labels, 600 candidates", supermarket},
      StoreTemplate{"hypermarket", "110 x 85 m: 40,000 labels, 2,000 candidates", hypermarket}};
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
