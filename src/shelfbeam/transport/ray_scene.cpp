#include "shelfbeam/transport/ray_scene.hpp"

#if SHELFBEAM_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

// What single precision loses of a coordinate, relative to the largest one.
constexpr double rounding = 1.0 / (1 << 24);
// Rays start this many such losses off a surface, and end four times as far before a point, where a surface
// that it touches may be met at a flat angle. A quarter of either is enough for all that tests have found.
constexpr double steps = 16, end_steps = 64;

struct Float3 {
  float x, y, z;
};

Float3 to_float(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

double largest_coordinate(const Scene& scene) {
  double largest = 0;
  const auto include = [&](const Vec3& p) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  };
  for (const Vec3& vertex : scene.mesh.vertices) include(vertex);
  for (const Label& label : scene.labels) include(label.position);
  for (const Transceiver& unit : scene.transceivers) include(unit.position);
  return largest;
}

#if SHELFBEAM_EMBREE_MAJOR == 3
void trace(RTCScene scene, RTCRayHit& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
}
void trace(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}
#else
void trace(RTCScene scene, RTCRayHit& ray) {
  rtcIntersect1(scene, &ray);
}
void trace(RTCScene scene, RTCRay& ray) {
  rtcOccluded1(scene, &ray);
}
#endif

RTCRay make_ray(const Float3& origin, const Float3& direction, float end) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = end;
  ray.mask = std::numeric_limits<unsigned>::max();
  return ray;
}

EmbreeScene build(RTCDevice device, const TriangleMesh& mesh, std::span<const std::uint32_t> chosen) {
  EmbreeScene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  if (chosen.empty()) {
    rtcCommitScene(scene.get());
    return scene;
  }
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  for (const Vec3& vertex : mesh.vertices) {
    const Float3 v = to_float(vertex);
    *vertices++ = v.x;
    *vertices++ = v.y;
    *vertices++ = v.z;
  }
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), chosen.size()));
  for (const std::uint32_t triangle : chosen)
    for (const std::uint32_t corner : mesh.triangles[triangle]) *indices++ = corner;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
    throw std::runtime_error(
        fmt::format("Embree could not build the scene (error {})", static_cast<int>(error)));
  return scene;
}

// Triangles of one kind, in their own Embree scene: Embree's ray masks, which could tell kinds apart, are not
// built into every package of it.
struct TriangleSet {
  std::vector<std::uint32_t> triangles;  // of the mesh, by Embree's number
  EmbreeScene scene;
};

struct Found {
  const TriangleSet* set;
  RTCRayHit query;
};

}  // namespace

struct RayScene::Impl {
  Device device;
  TriangleMesh mesh;
  std::vector<std::optional<ThinDielectric>> pane;  // by material
  TriangleSet opaque, panes;                        // `panes` has no scene where there are none
  double step = 0;                                  // m, how far from a surface rays start

  Float3 leave(const SurfacePoint& from, const Vec3& direction) const {
    return to_float(from.position + from.normal * std::copysign(step, dot(from.normal, direction)));
  }

  std::optional<Found> nearest(const TriangleSet& set, const RTCRay& ray) const {
    Found found{&set, {}};
    found.query.ray = ray;
    found.query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    trace(set.scene.get(), found.query);
    if (found.query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return found;
  }

  SurfacePoint point(const Found& found) const {
    // From the barycentric coordinates the point lies in the triangle's plane to rounding, however long the
    // ray.
    const auto& [a, b, c] = mesh.triangles[found.set->triangles[found.query.hit.primID]];
    const Vec3 p0 = mesh.vertices[a], e1 = mesh.vertices[b] - p0, e2 = mesh.vertices[c] - p0;
    return {p0 + e1 * static_cast<double>(found.query.hit.u) + e2 * static_cast<double>(found.query.hit.v),
            normalized(cross(e1, e2))};
  }
};

RayScene::RayScene(const Scene& scene) {
  auto impl = std::make_unique<Impl>();
  impl->mesh = scene.mesh;
  const double unit = rounding * largest_coordinate(scene);
  impl->step = steps * unit;
  end_ = end_steps * unit;
  for (const NamedMaterial& named : scene.materials) {
    const auto* pane = std::get_if<ThinDielectric>(&named.material);
    impl->pane.push_back(pane != nullptr ? std::optional(*pane) : std::nullopt);
  }
  impl->device.reset(rtcNewDevice(nullptr));
  if (!impl->device) throw std::runtime_error("Embree could not start a device");
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t)
    (impl->pane[scene.mesh.materials[t].value] ? impl->panes : impl->opaque).triangles.push_back(t);
  impl->opaque.scene = build(impl->device.get(), impl->mesh, impl->opaque.triangles);
  if (!impl->panes.triangles.empty())
    impl->panes.scene = build(impl->device.get(), impl->mesh, impl->panes.triangles);
  impl_ = std::move(impl);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<Hit> RayScene::intersect(const SurfacePoint& from, const Vec3& direction) const {
  RTCRay ray =
      make_ray(impl_->leave(from, direction), to_float(direction), std::numeric_limits<float>::infinity());
  auto found = impl_->nearest(impl_->opaque, ray);
  if (impl_->panes.scene) {
    if (found) ray.tfar = found->query.ray.tfar;
    if (const auto pane = impl_->nearest(impl_->panes, ray)) found = pane;
  }
  if (!found) return std::nullopt;
  const std::uint32_t triangle = found->set->triangles[found->query.hit.primID];
  return Hit{impl_->point(*found), impl_->mesh.materials[triangle], triangle};
}

Passage RayScene::passage(const SurfacePoint& from, const Vec3& to) const {
  const Float3 target = to_float(to);
  const auto ray_from = [&](const SurfacePoint& at) {
    const Vec3 way = to - at.position;
    const Float3 origin = impl_->leave(at, way);
    return make_ray(origin, {target.x - origin.x, target.y - origin.y, target.z - origin.z},
                    static_cast<float>(std::max(0.0, 1 - end_ / length(way))));
  };
  RTCRay ray = ray_from(from);
  trace(impl_->opaque.scene.get(), ray);
  Passage passage;
  if (ray.tfar < 0) return {0, 0};
  if (!impl_->panes.scene) return passage;

  const Vec3 direction = normalized(to - from.position);
  for (SurfacePoint at = from; passage.share > 0;) {
    const auto pane = impl_->nearest(impl_->panes, ray_from(at));
    if (!pane) break;
    at = impl_->point(*pane);
    if (dot(to - at.position, direction) <= 0) break;
    const MaterialId material = impl_->mesh.materials[pane->set->triangles[pane->query.hit.primID]];
    const auto [reflected, transmitted] =
        pane_shares(*impl_->pane[material.value], dot(at.normal, direction));
    passage.share *= transmitted;
    passage.probability *= transmitted > 0 ? transmitted / (reflected + transmitted) : 0;
  }
  return passage;
}

}  // namespace shelfbeam
