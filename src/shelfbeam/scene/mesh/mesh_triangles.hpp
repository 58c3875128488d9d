#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// The triangles of a mesh file by material, in the order of the materials' first appearance. The empty name
/// means no material. Also remarks about the file.
class MeshTriangles {
 public:
  using Triangle = std::array<Vec3, 3>;
  struct OfMaterial {
    std::string name;
    std::vector<Triangle> triangles;
  };

  /// `memory`: limit for the triangles, bytes.
  explicit MeshTriangles(std::size_t memory) : memory_(memory) {}

  /// Sets the material of all following triangles.
  void use(std::string_view material);
  /// False at the memory limit.
  [[nodiscard]] bool add(const Triangle& triangle);
  /// Adds a face as triangles; a face with fewer than three corners adds nothing. The face may be concave,
  /// but must be nearly flat. False at the memory limit and for a concave face with more than `max_corners`.
  [[nodiscard]] bool add_face(std::span<const Vec3> corners);
  static constexpr std::size_t max_corners = 256;

  const std::vector<OfMaterial>& all() const { return all_; }

  /// A remark about the file for its user, once ("uses ...").
  void note(const std::string& remark);
  /// Notes that vertices within these bounds, which the file stores in single precision, are so far from its
  /// origin that rounding shows.
  void note_single_precision(const Bounds& bounds);
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::size_t memory_;
  std::size_t count_ = 0;
  std::size_t current_ = 0;
  std::vector<OfMaterial> all_;
  std::vector<std::string> notes_;
};

}  // namespace shelfbeam
