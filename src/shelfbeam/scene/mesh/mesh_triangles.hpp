#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// The triangles of a mesh file by the material that it names for them, in the order in which materials come;
/// the empty name stands for none.
class MeshTriangles {
 public:
  using Triangle = std::array<Vec3, 3>;
  struct OfMaterial {
    std::string name;
    std::vector<Triangle> triangles;
  };

  /// `memory`: bytes that triangles may take.
  explicit MeshTriangles(std::size_t memory) : memory_(memory) {}

  /// What follows is of this material.
  void use(std::string_view material);
  /// False when the memory is full.
  [[nodiscard]] bool add(const Triangle& triangle);
  /// As triangles; faces with fewer than three corners have none. A face need not be convex, but must be
  /// nearly flat. False also for one that is not convex and has more than `most_corners`.
  [[nodiscard]] bool add_face(std::span<const Vec3> corners);
  static constexpr std::size_t most_corners = 256;

  const std::vector<OfMaterial>& all() const { return all_; }

 private:
  std::size_t memory_;
  std::size_t count_ = 0;
  std::size_t current_ = 0;
  std::vector<OfMaterial> all_;
};

}  // namespace shelfbeam
