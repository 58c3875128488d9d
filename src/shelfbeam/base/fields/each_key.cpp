#include "shelfbeam/base/fields/each_key.hpp"

#include <algorithm>

namespace shelfbeam {

namespace {

class KeyList final : public EachKey {
 public:
  std::vector<std::string_view> keys;

  void key(std::string_view name, const Field&) override {
    if (std::find(keys.begin(), keys.end(), name) == keys.end()) keys.push_back(name);
  }
};

}  // namespace

std::vector<std::string_view> keys_of(const Fields::Part& part) {
  KeyList list;
  part(list);
  return list.keys;
}

}  // namespace shelfbeam
