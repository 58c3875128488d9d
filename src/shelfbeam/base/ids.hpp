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

using MaterialId = Index<struct MaterialTag>;
using LabelTypeId = Index<struct LabelTypeTag>;
using TransceiverTypeId = Index<struct TransceiverTypeTag>;

}  // namespace shelfbeam
