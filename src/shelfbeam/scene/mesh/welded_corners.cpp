#include "shelfbeam/scene/mesh/welded_corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_map>

namespace shelfbeam {

namespace {

// Positions in cubic cells, so that few positions are compared.
class CornerCells {
 public:
  explicit CornerCells(double tolerance) : tolerance_(tolerance), side_(4 * tolerance) {}

  std::uint32_t number_of(const Vec3& p) {
    if (const auto found = near(p)) return *found;
    const auto number = static_cast<std::uint32_t>(positions_.size());
    positions_.push_back(p);
    numbers_.emplace(cell_of(p), number);
    return number;
  }

 private:
  using Cell = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::size_t hash = 0;
      for (const double x : cell) hash = (hash ^ std::hash<double>()(x)) * 0x9E3779B97F4A7C15U;
      return hash ^ hash >> 32;
    }
  };

  // Adding 0 turns -0 into +0.
  double along(double x) const { return (side_ > 0 ? std::floor(x / side_) : x) + 0.0; }
  Cell cell_of(const Vec3& p) const { return {along(p.x), along(p.y), along(p.z)}; }

  std::optional<std::uint32_t> near(const Vec3& p) const {
    const Vec3 reach{tolerance_, tolerance_, tolerance_};
    const Cell low = cell_of(p - reach), high = cell_of(p + reach);
    for (int corner = 0; corner < 8; ++corner) {
      Cell cell = low;
      bool is_new = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
        if ((corner >> axis & 1) != 0) {
          is_new = is_new && high[axis] != low[axis];
          cell[axis] = high[axis];
        }
      if (!is_new) continue;
      const auto [first, last] = numbers_.equal_range(cell);
      for (auto each = first; each != last; ++each)
        if (length_squared(positions_[each->second] - p) <= tolerance_ * tolerance_) return each->second;
    }
    return {};
  }

  double tolerance_, side_;
  std::vector<Vec3> positions_;
  std::unordered_multimap<Cell, std::uint32_t, Hash> numbers_;
};

}  // namespace

WeldedCorners welded(const std::vector<SolidTriangle>& triangles) {
  WeldedCorners result;
  double shortest = HUGE_VAL, largest = 0;
  for (const auto& [corners, has_area] : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = corners[k];
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      if (has_area) shortest = std::min(shortest, length(corners[(k + 1) % 3] - p));
    }
  result.rounding = largest / (1 << 23);
  CornerCells cells(std::min(result.rounding, shortest / 4));
  for (const SolidTriangle& triangle : triangles) {
    auto& numbers = result.numbers.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) numbers[k] = cells.number_of(triangle.corners[k]);
  }
  return result;
}

}  // namespace shelfbeam
