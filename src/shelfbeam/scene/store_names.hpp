#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/base/json.hpp"

namespace shelfbeam {

/// The names in one list of a store. An unknown name throws InputError at the location of the reference, or
/// Consequence if the list has problems (Problems::mark).
template <class Id>
class NameIndex {
 public:
  template <class List>
  NameIndex(const char* what, const List& list, const Problems* problems) : what_(what), problems_(problems) {
    for (const auto& item : list) names_.emplace(item.name, static_cast<std::uint32_t>(names_.size()));
  }
  Id operator()(const std::string& name, const std::string& where) const { return {find(name, where)}; }
  Id operator()(const JsonCursor& name) const { return {find(name.text(), name.where(), &name)}; }

 private:
  std::uint32_t find(const std::string& name, const std::string& where,
                     const JsonCursor* cursor = nullptr) const;

  const char* what_;
  const Problems* problems_;
  std::map<std::string, std::uint32_t, std::less<>> names_;
};

/// Looks up the names to which a store file refers.
struct StoreNames {
  template <class Store>
  explicit StoreNames(const Store& store, const Problems* problems = nullptr)
      : material("material", store.materials, problems),
        label_type("label type", store.label_types, problems),
        transceiver_type("transceiver type", store.transceiver_types, problems) {}

  /// The index in a list of the member with this name.
  std::uint32_t index(NameList list, const JsonCursor& name) const;

  NameIndex<MaterialId> material;
  NameIndex<LabelTypeId> label_type;
  NameIndex<TransceiverTypeId> transceiver_type;
};

}  // namespace shelfbeam
