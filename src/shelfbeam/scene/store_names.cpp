#include "shelfbeam/scene/store_names.hpp"

#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

using Names = std::map<std::string, std::uint32_t, std::less<>>;

template <class List>
Names index_by_name(const List& list) {
  Names names;
  for (const auto& item : list) names.emplace(item.name, static_cast<std::uint32_t>(names.size()));
  return names;
}

std::uint32_t look_up(const Names& names, const std::string& name, const std::string& where,
                      const char* what) {
  if (const auto found = names.find(name); found != names.end()) return found->second;
  std::vector<std::string_view> known;
  for (const auto& [key, index] : names) known.push_back(key);
  throw InputError(where, fmt::format("there is no {} '{}'", what, name),
                   known.empty() ? fmt::format("define it first") : suggest(name, known));
}

}  // namespace

StoreNames::StoreNames(const std::vector<NamedMaterial>& materials, const std::vector<LabelType>& label_types,
                       const std::vector<TransceiverType>& transceiver_types)
    : materials_(index_by_name(materials)),
      label_types_(index_by_name(label_types)),
      transceiver_types_(index_by_name(transceiver_types)) {}

MaterialId StoreNames::material(const std::string& name, const std::string& where) const {
  return {look_up(materials_, name, where, "material")};
}
LabelTypeId StoreNames::label_type(const std::string& name, const std::string& where) const {
  return {look_up(label_types_, name, where, "label type")};
}
TransceiverTypeId StoreNames::transceiver_type(const std::string& name, const std::string& where) const {
  return {look_up(transceiver_types_, name, where, "transceiver type")};
}
MaterialId StoreNames::material(const JsonCursor& name) const {
  return material(name.text(), name.where());
}
LabelTypeId StoreNames::label_type(const JsonCursor& name) const {
  return label_type(name.text(), name.where());
}
TransceiverTypeId StoreNames::transceiver_type(const JsonCursor& name) const {
  return transceiver_type(name.text(), name.where());
}

}  // namespace shelfbeam
