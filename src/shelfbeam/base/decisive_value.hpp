#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The values of a store on which the answer of a plan rests most, the most influential kind first: threshold
/// and power scale every signal or its requirement, responsivity and height most of them.
enum class ValueKind : std::uint8_t { threshold, power, responsivity, height, reflectance, price };
template <>
inline constexpr auto names_of<ValueKind> =
    std::to_array<Named<ValueKind>>({{"threshold", ValueKind::threshold},
                                     {"power", ValueKind::power},
                                     {"responsivity", ValueKind::responsivity},
                                     {"height", ValueKind::height},
                                     {"reflectance", ValueKind::reflectance},
                                     {"price", ValueKind::price}});

/// How well a value is known, the least first.
enum class ValueState : std::uint8_t {
  assumed,   ///< from the starter, from a product that is an assumption, or equal to the starter's value
  given,     ///< in the file without a mark
  confirmed  ///< a person has confirmed this very value
};
template <>
inline constexpr auto names_of<ValueState> = std::to_array<Named<ValueState>>(
    {{"assumed", ValueState::assumed}, {"given", ValueState::given}, {"confirmed", ValueState::confirmed}});

/// The origin of the values of a product or a store.
enum class ValueSource : std::uint8_t { datasheet, measured, assumption, example };
template <>
inline constexpr auto names_of<ValueSource> =
    std::to_array<Named<ValueSource>>({{"datasheet", ValueSource::datasheet},
                                       {"measured", ValueSource::measured},
                                       {"assumption", ValueSource::assumption},
                                       {"example", ValueSource::example}});

/// One of these values, and how well it is known.
struct DecisiveValue {
  ValueKind kind = ValueKind::threshold;
  std::string of = {};  ///< name of the type or material; empty for the height
  ValueState state = ValueState::given;
  /// W/m^2, W, m, share or price; 0 for a responsivity and for a ceiling that is not level.
  double amount = 0;
  /// As `confirmed` in a store file holds it (docs/formats/store/values.md), with lengths in m: JSON.
  std::string value = {};

  bool is(const DecisiveValue& other) const { return kind == other.kind && of == other.of; }
};

/// The origin of the values of a type of labels or transceivers.
struct TypeOrigin {
  std::string name = {};  ///< for reports; of a type made from a product, that of the product
  std::optional<ValueSource> source = {};
  std::vector<ValueKind> sourced = {};  ///< values that the product or type with the source has itself
};

}  // namespace shelfbeam
