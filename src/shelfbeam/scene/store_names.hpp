#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Looks up names that a store file refers to. Throws InputError at the place of the reference.
class StoreNames {
 public:
  StoreNames(const std::vector<NamedMaterial>& materials, const std::vector<LabelType>& label_types,
             const std::vector<TransceiverType>& transceiver_types);
  template <class Store>
  explicit StoreNames(const Store& store)
      : StoreNames(store.materials, store.label_types, store.transceiver_types) {}

  MaterialId material(const JsonCursor& name) const;
  LabelTypeId label_type(const JsonCursor& name) const;
  TransceiverTypeId transceiver_type(const JsonCursor& name) const;

  MaterialId material(const std::string& name, const std::string& where) const;
  LabelTypeId label_type(const std::string& name, const std::string& where) const;
  TransceiverTypeId transceiver_type(const std::string& name, const std::string& where) const;

 private:
  std::map<std::string, std::uint32_t, std::less<>> materials_, label_types_, transceiver_types_;
};

}  // namespace shelfbeam
