#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The surfaces that are so near to glass (panes or solid glass) that rays in single precision cannot tell
/// them apart: those of a poster on a glass door, a jar on a table, two panes in one plane. Along a ray,
/// their order follows from their positions in double precision, with one exception: solids that overlap by
/// up to `max_overlap` count as touching, so light leaves one solid before it enters the other.
///
/// The order of two surfaces in the same place is that of their triangles in the scene, seen from one side;
/// it is reversed for light from the other side.
class Contacts {
 public:
  static constexpr double max_overlap = 3e-5;  ///< m, of two solids; half of it for a solid and a sheet

  /// Surfaces are in contact within `reach` along the normal, m, if their normals differ by up to 11 degrees.
  Contacts(const Scene& scene, double reach);

  bool contain(std::uint32_t triangle) const {
    return triangle < face_of_.size() && first_[triangle] != first_[triangle + 1];
  }

  /// A surface of a stack, where a line crosses it.
  struct Crossing {
    std::uint32_t triangle;
    double distance;  ///< along the line from the given point, m
    double rank;      ///< place in the order
  };

  /// The triangle and all triangles in contact with it that a line meets, in the order in which light in this
  /// direction meets them. `at` is the point where the line meets the triangle.
  std::vector<Crossing> stack(std::uint32_t triangle, const Vec3& at, const Vec3& direction) const;

  bool are_partners(std::uint32_t a, std::uint32_t b) const;
  const Vec3& normal(std::uint32_t triangle) const { return faces_[face_of_[triangle]].normal; }
  MaterialId material(std::uint32_t triangle) const { return faces_[face_of_[triangle]].material; }

 private:
  struct Face {
    Vec3 corner, edge1, edge2;
    MaterialId material;
    Vec3 normal;       ///< unit length, by the winding
    double solid = 0;  ///< 1 if a solid lies behind the normal, -1 if before it, 0 for a sheet
  };
  bool touch(const Face& a, const Face& b) const;
  void find_solids(const Scene& scene);

  double reach_;
  std::vector<std::uint32_t> first_;     ///< by triangle: its first partner
  std::vector<std::uint32_t> partners_;  ///< triangles
  std::vector<std::uint32_t> face_of_;   ///< by triangle: index into faces_
  std::vector<Face> faces_;
};

}  // namespace shelfbeam
