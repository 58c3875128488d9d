#include "shelfbeam/scene/mesh/mesh_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

// The normal with twice the area as its length, by Newell's rule.
Vec3 normal_of(std::span<const Vec3> corners) {
  Vec3 sum{0, 0, 0};
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum = sum + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
  return sum;
}

// Ear clipping: cuts off convex corners whose triangle contains no other corner.
class EarClipping {
 public:
  explicit EarClipping(std::span<const Vec3> corners) : corners_(corners), normal_(normal_of(corners)) {
    left_.resize(corners.size());
    std::iota(left_.begin(), left_.end(), 0U);
  }

  bool is_convex() const {
    for (std::size_t k = 0; k < left_.size(); ++k)
      if (turn(before(k), left_[k], after(k)) < 0) return false;
    return true;
  }

  template <class Use>
  void cut(Use use) {
    while (left_.size() > 3) {
      std::size_t ear = 0;
      while (ear < left_.size() && !is_ear(ear)) ++ear;
      // A self-intersecting face may have no ear; then any corner is cut.
      if (ear == left_.size()) ear = 0;
      use(before(ear), left_[ear], after(ear));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    use(left_[0], left_[1], left_[2]);
  }

 private:
  std::size_t before(std::size_t k) const { return left_[(k + left_.size() - 1) % left_.size()]; }
  std::size_t after(std::size_t k) const { return left_[(k + 1) % left_.size()]; }

  double turn(std::size_t a, std::size_t b, std::size_t c) const {
    return dot(cross(corners_[b] - corners_[a], corners_[c] - corners_[b]), normal_);
  }

  bool is_ear(std::size_t k) const {
    const std::size_t a = before(k), b = left_[k], c = after(k);
    if (turn(a, b, c) <= 0) return false;
    return std::none_of(left_.begin(), left_.end(), [&](std::size_t p) {
      return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  std::span<const Vec3> corners_;
  Vec3 normal_;
  std::vector<std::size_t> left_;
};

}  // namespace

void MeshTriangles::use(std::string_view material) {
  const auto found =
      std::find_if(all_.begin(), all_.end(), [&](const auto& m) { return m.name == material; });
  current_ = static_cast<std::size_t>(found - all_.begin());
  if (found == all_.end()) all_.push_back({std::string(material), {}});
}

void MeshTriangles::note(const std::string& remark) {
  if (std::find(notes_.begin(), notes_.end(), remark) == notes_.end()) notes_.push_back(remark);
}

void MeshTriangles::note_single_precision(const Bounds& bounds) {
  constexpr double visible = 1e-4;  // of the size of the mesh
  double largest = 0, size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::abs(bounds.low[axis]), std::abs(bounds.high[axis])});
    size = std::max(size, bounds.high[axis] - bounds.low[axis]);
  }
  const double rounding = largest / (1 << 24);
  if (std::isfinite(largest) && rounding > visible * size)
    note(fmt::format(
        "stores vertices up to {:.4g} from its origin in single precision, which rounds them by up to "
        "{:.2g}; export it near its origin",
        largest, rounding));
}

bool MeshTriangles::add(const Triangle& triangle) {
  if (++count_ > memory_ / sizeof triangle) return false;
  if (all_.empty()) use("");
  all_[current_].triangles.push_back(triangle);
  return true;
}

bool MeshTriangles::add_face(std::span<const Vec3> corners) {
  if (corners.size() < 3) return true;
  if (corners.size() == 3) return add({corners[0], corners[1], corners[2]});
  EarClipping ears(corners);
  if (ears.is_convex()) {
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      if (!add({corners[0], corners[k], corners[k + 1]})) return false;
    return true;
  }
  if (corners.size() > max_corners) return false;
  bool fits = true;
  ears.cut([&](std::size_t a, std::size_t b, std::size_t c) {
    fits = fits && add({corners[a], corners[b], corners[c]});
  });
  return fits;
}

}  // namespace shelfbeam
