#pragma once

#include <array>
#include <string>
#include <vector>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The parts of a store file. `shop`: its name, its wavelength and its currency.
enum class StorePart {
  shop,
  room,
  materials,
  label_types,
  transceiver_types,
  variation,
  fixtures,
  labels,
  transceivers
};

template <>
inline constexpr auto names_of<StorePart> =
    std::to_array<Named<StorePart>>({{"shop", StorePart::shop},
                                     {"room", StorePart::room},
                                     {"materials", StorePart::materials},
                                     {"label_types", StorePart::label_types},
                                     {"transceiver_types", StorePart::transceiver_types},
                                     {"variation", StorePart::variation},
                                     {"fixtures", StorePart::fixtures},
                                     {"labels", StorePart::labels},
                                     {"transceivers", StorePart::transceivers}});

enum class StoreChangeKind {
  added,
  removed,
  moved,    ///< another position or direction, nothing else
  renamed,  ///< another id, nothing else
  changed
};

template <>
inline constexpr auto names_of<StoreChangeKind> =
    std::to_array<Named<StoreChangeKind>>({{"added", StoreChangeKind::added},
                                           {"removed", StoreChangeKind::removed},
                                           {"moved", StoreChangeKind::moved},
                                           {"renamed", StoreChangeKind::renamed},
                                           {"changed", StoreChangeKind::changed}});

/// A key with two values, as JSON texts; empty: the key is missing.
struct ValueChange {
  std::string key;  ///< path in its element ("labels.spacing", "inner_walls[W1].to")
  std::string before, after;

  bool operator==(const ValueChange&) const = default;
};

/// A difference in an element of a store, or in a part without elements.
struct StoreChange {
  StorePart part = StorePart::shop;
  StoreChangeKind kind = StoreChangeKind::changed;
  std::string before_id, after_id;  ///< empty: it does not exist, or the part has no elements
  std::vector<ValueChange> values;
  std::string description = {};  ///< of the article of a label

  const std::string& id() const { return after_id.empty() ? before_id : after_id; }
  bool operator==(const StoreChange&) const = default;
};

/// The changes between two stores, given by resolved_store_json, in the order of the parts. Elements are
/// matched by id, renamed ones by their values. The lists of ids of transceivers ("installed") are keys of
/// the listed ones. Numbers that agree to nine digits are equal.
std::vector<StoreChange> store_changes(const std::string& before, const std::string& after);

}  // namespace shelfbeam
