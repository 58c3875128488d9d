#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The part of a straight line inside a convex body, in m from its origin.
struct Stretch {
  double begin = -std::numeric_limits<double>::infinity(), end = -begin;

  /// Keeps the part where `distance + t * slope` is positive.
  void clip(double distance, double slope);
};

/// The part of a line inside a block, with the block's sides moved inwards by `inset`. Precondition: the
/// block's footprint is convex.
Stretch stretch_within(const Part& block, const Vec3& p, const Vec3& direction, double inset = 0);

Bounds bounds_of(const Part& part);
BoxIndex index_of(const std::vector<const Part*>& parts);

/// The blocks of a scene: all opaque parts of fixtures except meshes, of which only the hull is a block.
class Blocks {
 public:
  static constexpr double rounding = 1e-6;  ///< m
  static constexpr double too_near = 0.05;  ///< m in front of a label

  /// The scene must outlive this object. With `max_visits`, for use on one thread, it finds no more blocks
  /// after that many have met the boxes of all searches: thousands of blocks may be at one place.
  explicit Blocks(const Scene& scene, std::size_t max_visits = std::numeric_limits<std::size_t>::max());
  /// The visits for as many devices in a shop whose fixtures stand side by side.
  static std::size_t usual_visits(std::size_t devices) {
    constexpr std::size_t least = 20'000'000, each = 100;
    return std::max(least, each * devices);
  }
  bool is_exhausted() const { return visits_ >= max_visits_; }

  struct Hit {
    const std::string* fixture;
    double distance;  ///< m; negative from within
    bool is_within() const { return distance < -rounding; }
  };
  /// The first block along the direction within 5 cm, or the block that contains the point.
  std::optional<Hit> next(const Vec3& p, const Vec3& direction) const;
  /// Also true after `max_visits`.
  bool contain(const Vec3& p) const;

  /// Calls `use(part)` for the blocks whose bounds meet a box, until it returns true. Returns whether it did.
  template <class Use>
  bool any(const Bounds& box, const Use& use) const {
    bool is_found = false;
    index_.any(box, [&](std::uint32_t k) {
      if (has_limit_ && visits_++ >= max_visits_) return true;
      is_found = use(*blocks_[k]);
      return is_found;
    });
    return is_found;
  }
  const std::vector<const Part*>& all() const { return blocks_; }

 private:
  const Scene& scene_;
  std::vector<const Part*> blocks_;
  BoxIndex index_;
  std::size_t max_visits_;
  bool has_limit_;
  mutable std::size_t visits_ = 0;
};

}  // namespace shelfbeam
