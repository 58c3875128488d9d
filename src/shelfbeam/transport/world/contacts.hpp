#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The surfaces that are so near to glass (panes or solid glass) that rays in single precision cannot tell
/// them apart: those of a poster on a glass door, a jar on a table, two panes in one plane. Along a ray,
/// their order follows from their positions in double precision, with one exception: solids that overlap by
/// up to `overlap` count as touching, so light leaves one solid before it enters the other.
///
/// The order of two surfaces in the same place is that of their triangles in the scene, seen from one side;
/// it is reversed for light from the other side.
class Contacts {
 public:
  struct Limits {
    double reach;    ///< largest distance along the normal, m
    double overlap;  ///< of two solids, m; half of it for a solid and a sheet
  };

  /// Surfaces are in contact if their planes differ by up to 11 degrees.
  Contacts(const Scene& scene, const Limits& limits);

  /// Whether a triangle is in contact with another one near a point on it.
  bool contain(std::uint32_t triangle, const Vec3& at) const {
    return has_contact(triangle) && has_partner_at(triangle, at);
  }

  /// A surface of a stack, where a line crosses it.
  struct Crossing {
    std::uint32_t triangle;
    double distance;  ///< along the line from the given point, m
    double rank;      ///< place in the order: the distance, with the allowance for overlaps, nm
  };

  /// The triangle and all triangles with contacts that a line meets within reach, in the order in which light
  /// in this direction meets them. `at` is the point where the line meets the triangle.
  std::vector<Crossing> stack(std::uint32_t triangle, const Vec3& at, const Vec3& direction) const;

  bool are_partners(std::uint32_t a, std::uint32_t b) const;
  const Vec3& normal(std::uint32_t triangle) const { return face(triangle).normal; }
  MaterialId material(std::uint32_t triangle) const { return face(triangle).material; }

 private:
  struct Face {
    std::uint32_t triangle;
    Vec3 corner, edge1, edge2;
    MaterialId material;
    Vec3 normal;       ///< unit length, by the winding
    double solid = 0;  ///< 1 if a solid lies behind the normal, -1 if before it, 0 for a sheet

    Bounds bounds() const;
  };
  const Face& face(std::uint32_t triangle) const { return faces_[face_of_[triangle]]; }
  bool has_contact(std::uint32_t triangle) const {
    return triangle < face_of_.size() && first_[triangle] != first_[triangle + 1];
  }
  bool has_partner_at(std::uint32_t triangle, const Vec3& at) const;
  std::span<const std::uint32_t> partners(std::uint32_t triangle) const {
    return std::span(partners_).subspan(first_[triangle], first_[triangle + 1] - first_[triangle]);
  }
  static Face make_face(const TriangleMesh& mesh, std::uint32_t triangle);
  bool touch(const Face& a, const Face& b) const;
  void find_solids(const Scene& scene);

  Limits limits_;
  std::vector<std::uint32_t> first_;     ///< by triangle: its first partner
  std::vector<std::uint32_t> partners_;  ///< triangles, in ascending order for each triangle
  std::vector<std::uint32_t> face_of_;   ///< by triangle: index into faces_
  std::vector<Face> faces_;              ///< of triangles with partners
  BoxIndex index_{{}};                   ///< over faces_
};

}  // namespace shelfbeam
