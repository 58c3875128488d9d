#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/base/json.hpp"

namespace shelfbeam {

/// The names in one list of a store. An unknown name throws InputError at the location of the reference.
template <class Id>
class NameIndex {
 public:
  template <class List>
  NameIndex(const char* what, const List& list) : what_(what) {
    for (const auto& item : list) names_.emplace(item.name, static_cast<std::uint32_t>(names_.size()));
  }
  Id operator()(const std::string& name, const std::string& where) const { return {find(name, where)}; }
  Id operator()(const JsonCursor& name) const { return {find(name.text(), name.where())}; }

 private:
  std::uint32_t find(const std::string& name, const std::string& where) const;

  const char* what_;
  std::map<std::string, std::uint32_t, std::less<>> names_;
};

/// Looks up the names to which a store file refers.
struct StoreNames {
  template <class Store>
  explicit StoreNames(const Store& store)
      : material("material", store.materials),
        label_type("label type", store.label_types),
        transceiver_type("transceiver type", store.transceiver_types) {}

  NameIndex<MaterialId> material;
  NameIndex<LabelTypeId> label_type;
  NameIndex<TransceiverTypeId> transceiver_type;
};

}  // namespace shelfbeam
