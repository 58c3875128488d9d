#include "shelfbeam/scene/build/sound_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

namespace {

// A single-precision coordinate errs by 2^-24 of its size; a triangle that is no higher than a few such
// errors has no area and no normal that mean anything.
bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double rounding = 4.0 / (1 << 24);
  double size = 0;
  for (const Vec3& p : {a, b, c}) size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double longest =
      std::sqrt(std::max({length_squared(b - a), length_squared(c - b), length_squared(a - c)}));
  return length(cross(b - a, c - a)) > rounding * size * longest;
}

std::size_t drop_without_area(MeshPiece& piece) {
  return std::erase_if(piece.triangles, [&](const auto& t) {
    return !has_area(piece.vertices[t[0]], piece.vertices[t[1]], piece.vertices[t[2]]);
  });
}

// Whether each edge is run through as often one way as the other. Files repeat a vertex for each normal or
// texture coordinate that it has, so places are compared, not numbers.
bool is_closed(const MeshPiece& piece) {
  std::map<std::tuple<double, double, double>, std::size_t> places;
  std::vector<std::size_t> place;
  for (const Vec3& p : piece.vertices)
    place.push_back(places.emplace(std::tuple{p.x, p.y, p.z}, places.size()).first->second);
  std::map<std::pair<std::size_t, std::size_t>, int> excess;
  for (const auto& triangle : piece.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = place[triangle[k]], b = place[triangle[(k + 1) % 3]];
      if (a != b) excess[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return std::all_of(excess.begin(), excess.end(), [](const auto& edge) { return edge.second == 0; });
}

// By the divergence theorem, about a vertex of the piece so that a far origin costs no digits.
double volume(const MeshPiece& piece) {
  const Vec3 origin = piece.vertices.front();
  double six = 0;
  for (const auto& [a, b, c] : piece.triangles)
    six += dot(piece.vertices[a] - origin, cross(piece.vertices[b] - origin, piece.vertices[c] - origin));
  return six / 6;
}

// Refraction needs to know inside from outside.
void turn_outside_out(MeshPiece& piece, const std::string& what, bool closed, WarningList& warnings) {
  if (!closed) {
    warnings.add("open surfaces of solid dielectrics",
                 what +
                     " is not closed, so light that enters the solid may never leave it; close it with all "
                     "triangles looking outwards, or make it a 'thin_dielectric'");
  } else if (volume(piece) < 0) {
    for (auto& triangle : piece.triangles) std::swap(triangle[1], triangle[2]);
    warnings.add("surfaces of solid dielectrics that were inside out",
                 what + " was inside out and is turned over; let its triangles look outwards");
  }
}

double longest_side(const MeshFixture& mesh) {
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const MeshPiece& piece : mesh.pieces)
      for (const auto& triangle : piece.triangles)
        for (const std::uint32_t v : triangle) {
          low = std::min(low, piece.vertices[v][axis]);
          high = std::max(high, piece.vertices[v][axis]);
        }
    longest = std::max(longest, high - low);
  }
  return longest * mesh.scale;
}

void check_size(const MeshFixture& mesh, const Store& store, const std::string& where,
                WarningList& warnings) {
  const double size = longest_side(mesh);
  const std::string problem = fmt::format("mesh '{}' is {:.4g} m across", mesh.id, size);
  const char* advice =
      "'scale' is the metres that a unit of the file stands for: \"scale\": 0.001 for millimetres";
  if (size < 1e-3)
    throw InputError(where, problem,
                     "'scale' is the metres that a unit of the file stands for: 1 for metres");
  if (store.room) {
    const Vec3& room = store.room->size;
    if (size >= 10 * std::max({room.x, room.y, room.z}))
      throw InputError(where, fmt::format("{}, ten times the room or more", problem), advice);
  }
  if (size > 200) warnings.add("meshes above 200 m", fmt::format("{}: {}; {}", where, problem, advice));
}

}  // namespace

MeshFixture sound_mesh(MeshFixture mesh, const Store& store, const std::string& where,
                       WarningList& warnings) {
  std::size_t count = 0, dropped = 0;
  for (MeshPiece& piece : mesh.pieces) {
    const NamedMaterial& material = store.materials[piece.material.value];
    const bool is_solid = std::holds_alternative<Dielectric>(material.material);
    // A sliver may close a seam, or only lie on a surface that is closed without it.
    const bool closed_with_slivers = is_solid && is_closed(piece);
    count += piece.triangles.size();
    dropped += drop_without_area(piece);
    if (is_solid && !piece.triangles.empty())
      turn_outside_out(piece,
                       fmt::format("{}: the surface of mesh '{}' made of the solid dielectric '{}'", where,
                                   mesh.id, material.name),
                       closed_with_slivers || is_closed(piece), warnings);
  }
  std::erase_if(mesh.pieces, [](const MeshPiece& piece) { return piece.triangles.empty(); });
  if (mesh.pieces.empty())
    throw InputError(where, fmt::format("no triangle of mesh '{}' has an area", mesh.id), "check the mesh");
  if (dropped > 0)
    warnings.add("meshes with triangles without area",
                 fmt::format("{}: mesh '{}': dropped {} of {} triangles without area", where, mesh.id,
                             dropped, count));
  check_size(mesh, store, where, warnings);
  return mesh;
}

}  // namespace shelfbeam
