#pragma once

#include <compare>
#include <cstdint>

namespace shelfbeam {

/// Index into one particular list. Indices into different lists do not convert into each other.
template <class Tag>
struct Index {
  std::uint32_t value = 0;
  friend constexpr auto operator<=>(Index, Index) = default;
};

/// The number of an element of one particular list: converts from and to whole numbers, but not into the
/// number in another list, and lists of them are of different types. Single whole numbers are not checked.
template <class Tag>
class Number {
 public:
  constexpr Number() = default;
  constexpr Number(std::uint32_t value) : value_(value) {}
  constexpr operator std::uint32_t() const { return value_; }
  friend constexpr std::uint32_t format_as(Number number) { return number.value_; }  ///< for fmt
  template <class Json>
  friend void to_json(Json& json, Number number) {  ///< for nlohmann::json
    json = number.value_;
  }

 private:
  std::uint32_t value_ = 0;
};

using ColumnId = Number<struct ColumnTag>;  ///< a transceiver of a SignalTable
using LabelId = Number<struct LabelTag>;    ///< a label of a SignalTable
using MaterialId = Index<struct MaterialTag>;
using LabelTypeId = Index<struct LabelTypeTag>;
using TransceiverTypeId = Index<struct TransceiverTypeTag>;

}  // namespace shelfbeam
