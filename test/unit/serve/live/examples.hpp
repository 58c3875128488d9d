#pragma once

#include "serve/live/shop.hpp"
#include "serve/text/json_value.hpp"
#include "unit/serve/testing.hpp"

namespace shelfbeam::test {

/// The store file of an example.
inline fs::path example(const std::string& name) {
  return fs::path(SHELFBEAM_SOURCE_DIR "/examples") / name / "store.json";
}

/// The shop of an example that is being edited.
struct EditedShop : serve::Shop {
  explicit EditedShop(const std::string& name = "grocery")
      : Shop(example(name)), store(parse_json(read_file(example(name)), name)) {}

  serve::ShopChanges update() { return update(store.dump()); }
  serve::ShopChanges update(const std::string& text) { return Shop::update(text, ++revision); }
  /// The part of an element, or null.
  serve::Json part(const std::string& key) const {
    for (const serve::Json& part : parts())
      if (part["key"] == key) return part;
    return {};
  }

  serve::Json store;
  std::uint64_t revision = 0;
};

}  // namespace shelfbeam::test
