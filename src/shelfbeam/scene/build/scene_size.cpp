#include "shelfbeam/scene/build/scene_size.hpp"

#include <algorithm>
#include <optional>
#include <variant>

namespace shelfbeam {

namespace {

// With its id, the place in the file that it comes from, and what finds it by its id.
constexpr double device = 512;
// Twelve triangles, eight corners and what drawings know of it.
constexpr double box = 640;
constexpr double facing = 0.3;  // m; goods stand this wide or, one, wider

double labels_of(const std::optional<FixtureLabels>& labels, double longest, std::size_t levels) {
  if (!labels) return 0;
  return device * static_cast<double>(labels->faces.size() * levels) * (longest / labels->spacing + 1);
}

double size_of(const Gondola& g) {
  const auto levels = static_cast<double>(g.shelves.size() + 1);
  return box * static_cast<double>(g.faces.size()) * levels * (g.length / facing + 2) +
         labels_of(g.labels, g.length, g.shelves.size());
}

double size_of(const Freezer& f) {
  return box * (2 * f.length / facing + 10) + labels_of(f.labels, std::max(f.length, f.depth), 1);
}

double size_of(const Box&) {
  return box;
}

double size_of(const MeshFixture& m) {
  double size = 0;
  // As read, made sound, and in the scene.
  for (const MeshPiece& piece : m.pieces)
    size += 3.0 * static_cast<double>(piece.vertices.size() * sizeof(Vec3) + piece.triangles.size() * 16);
  return size;
}

}  // namespace

std::size_t scene_size(const Fixture& fixture) {
  return static_cast<std::size_t>(std::visit([](const auto& f) { return size_of(f); }, fixture));
}

std::size_t scene_size(const TransceiverGrid& grid) {
  return static_cast<std::size_t>(device * ((grid.max[0] - grid.min[0]) / grid.spacing + 2) *
                                  ((grid.max[1] - grid.min[1]) / grid.spacing + 2));
}

}  // namespace shelfbeam
