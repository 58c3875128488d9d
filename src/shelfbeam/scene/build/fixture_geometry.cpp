#include "shelfbeam/scene/build/fixture_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

constexpr double label_offset = 0.01;  // m: labels stand this far off the edge that carries them

struct Rotation {
  double cos, sin;
};

// Right angles are exact, so that a fixture turned by 90 degrees has no rounding of its own.
Rotation rotation(double degrees) {
  const double turns = std::fmod(std::fmod(degrees, 360) + 360, 360);
  if (turns == 0) return {1, 0};
  if (turns == 90) return {0, 1};
  if (turns == 180) return {-1, 0};
  if (turns == 270) return {0, -1};
  return {std::cos(radians(turns)), std::sin(radians(turns))};
}

}  // namespace

std::string_view face_name(Face face) {
  switch (face) {
    case Face::front:
      return "front";
    case Face::back:
      return "back";
    case Face::left:
      return "left";
    case Face::right:
      return "right";
  }
  return "";
}

std::vector<Vec2> rectangle_footprint(const Vec2& at, double length, double depth, double rotation_deg) {
  const Rotation turn = rotation(rotation_deg);
  const auto turned = [&](double x, double y) {
    return Vec2{at[0] + turn.cos * x - turn.sin * y, at[1] + turn.sin * x + turn.cos * y};
  };
  return {turned(0, 0), turned(length, 0), turned(length, depth), turned(0, depth)};
}

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto turns_left = [](const Vec2& o, const Vec2& a, const Vec2& b) {
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]) > 0;
  };
  std::vector<Vec2> hull;
  const auto half = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= start + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *it))
        hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  return hull;
}

FixtureBuilder::FixtureBuilder(Scene& scene, std::uint32_t fixture, const Vec3& at, double rotation_deg)
    : scene_(scene),
      fixture_(fixture),
      at_(at),
      cos_(rotation(rotation_deg).cos),
      sin_(rotation(rotation_deg).sin) {}

Vec3 FixtureBuilder::direction(const Vec3& local) const {
  return {cos_ * local.x - sin_ * local.y, sin_ * local.x + cos_ * local.y, local.z};
}

Vec3 FixtureBuilder::point(const Vec3& local) const {
  return at_ + direction(local);
}

std::vector<Vec2> FixtureBuilder::footprint(const Vec3& low, const Vec3& high) const {
  std::vector<Vec2> corners;
  for (const Vec3& corner :
       {Vec3{low.x, low.y, 0}, Vec3{high.x, low.y, 0}, Vec3{high.x, high.y, 0}, Vec3{low.x, high.y, 0}}) {
    const Vec3 p = point(corner);
    corners.push_back({p.x, p.y});
  }
  return corners;
}

void FixtureBuilder::add_box(PartKind kind, const Vec3& low, const Vec3& high, MaterialId material) {
  TriangleMesh& mesh = scene_.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back(point({(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                   (corner & 4) != 0 ? high.z : low.z}));
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangles.push_back({first + a, first + c, first + d});
    mesh.materials.insert(mesh.materials.end(), 2, material);
  }
  scene_.parts.push_back({kind, fixture_, material, footprint(low, high), at_.z + low.z, at_.z + high.z});
}

void FixtureBuilder::add_door(const Vec3& low, const Vec3& high, MaterialId material) {
  TriangleMesh& mesh = scene_.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& corner : {low, Vec3{high.x, low.y, low.z}, high, Vec3{low.x, high.y, high.z}})
    mesh.vertices.push_back(point(corner));
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.materials.insert(mesh.materials.end(), 2, material);
  scene_.parts.push_back(
      {PartKind::door, fixture_, material, footprint(low, high), at_.z + low.z, at_.z + high.z});
}

void FixtureBuilder::add_mesh(const MeshPiece& piece, double scale) {
  TriangleMesh& mesh = scene_.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  std::vector<Vec2> plan;
  Part part{PartKind::mesh,
            fixture_,
            piece.material,
            {},
            1e300,
            -1e300,
            static_cast<std::uint32_t>(mesh.triangles.size()),
            static_cast<std::uint32_t>(piece.triangles.size())};
  for (const Vec3& vertex : piece.vertices) {
    const Vec3 p = point(vertex * scale);
    mesh.vertices.push_back(p);
    plan.push_back({p.x, p.y});
    part.bottom = std::min(part.bottom, p.z);
    part.top = std::max(part.top, p.z);
  }
  for (const auto& [a, b, c] : piece.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.materials.push_back(piece.material);
  }
  part.footprint = convex_hull(std::move(plan));
  scene_.parts.push_back(std::move(part));
}

void FixtureBuilder::add_label_row(const FixtureLabels& labels, Face face, double size_x, double size_y,
                                   double z, int level) {
  const bool along_x = face == Face::front || face == Face::back;
  const double extent = along_x ? size_x : size_y;
  const auto count = std::max(1, static_cast<int>(std::floor(extent / labels.spacing + 1e-9)));
  const double first = (extent - (count - 1) * labels.spacing) / 2;
  const double out = face == Face::front || face == Face::left ? -1 : 1;
  const double across = out < 0 ? -label_offset : (along_x ? size_y : size_x) + label_offset;
  const double tilt = radians(labels.tilt_deg);
  const Vec3 outward = along_x ? Vec3{0, out, 0} : Vec3{out, 0, 0};
  const Vec3 normal = labels.tilt_deg == 0 ? outward : outward * std::cos(tilt) + Vec3{0, 0, std::sin(tilt)};
  for (int k = 0; k < count; ++k) {
    const double along = first + k * labels.spacing;
    Label label;
    label.id = fmt::format("{}-{}-{}-{}", scene_.fixtures[fixture_].id, face_name(face), level, k + 1);
    label.position = point(along_x ? Vec3{along, across, z} : Vec3{across, along, z});
    label.normal = direction(normal);
    label.type = labels.type;
    scene_.labels.push_back(std::move(label));
  }
}

std::vector<double> stock(std::size_t count, double stocking, const std::string& key) {
  std::vector<std::uint32_t> draw(count), order(count);
  const std::uint64_t stream = hash64(key);
  std::vector<double> fill(count, 0);
  for (std::size_t k = 0; k < count; ++k)
    draw[k] = philox({static_cast<std::uint32_t>(k), 0, 0, 0}, stream)[0];
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return draw[a] < draw[b]; });
  const auto filled = static_cast<std::size_t>(std::lround(stocking * static_cast<double>(count)));
  for (std::size_t k = 0; k < filled; ++k) {
    const double depletion = to_unit(philox({order[k], 1, 0, 0}, stream)[0]);
    fill[order[k]] = 1 - (1 - stocking) * depletion;
  }
  return fill;
}

}  // namespace shelfbeam
