#include "shelfbeam/transport/ray_scene.hpp"

#if SHELFBEAM_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

struct Float3 {
  float x, y, z;
};

Float3 to_float(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Moves one coordinate by about 64 units in the last place along the normal, or near zero by a fixed small
// length, where units in the last place are too small to count for what was computed from larger numbers.
float offset(float p, float n) {
  constexpr float near_zero = 1.0F / 32, small_step = 1.0F / 65536;
  if (std::abs(p) < near_zero) return p + small_step * n;
  const auto steps = static_cast<std::int32_t>(std::lround(64 * n));
  const auto bits = std::bit_cast<std::int32_t>(p);
  return std::bit_cast<float>(bits + (p < 0 ? -steps : steps));
}

Float3 leave_surface(const Vec3& origin, const Vec3& normal) {
  const Float3 p = to_float(origin), n = to_float(normal);
  return {offset(p.x, n.x), offset(p.y, n.y), offset(p.z, n.z)};
}

// A ray to a point that touches a surface ends this share of its length before it.
constexpr float shadow_end = 1 - 1.0F / 65536;

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

}  // namespace

struct RayScene::Impl {
  Device device;
  EmbreeScene scene;
  TriangleMesh mesh;
};

RayScene::RayScene(const TriangleMesh& mesh) {
  auto impl = std::make_unique<Impl>();
  impl->mesh = mesh;
  impl->device.reset(rtcNewDevice(nullptr));
  if (!impl->device) throw std::runtime_error("Embree could not start a device");
  impl->scene.reset(rtcNewScene(impl->device.get()));
  rtcSetSceneFlags(impl->scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl->scene.get(), RTC_BUILD_QUALITY_HIGH);

  RTCGeometry geometry = rtcNewGeometry(impl->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  for (const Vec3& vertex : mesh.vertices) {
    const Float3 v = to_float(vertex);
    *vertices++ = v.x;
    *vertices++ = v.y;
    *vertices++ = v.z;
  }
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                              mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) *indices++ = corner;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl->scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(impl->scene.get());
  if (const RTCError error = rtcGetDeviceError(impl->device.get()); error != RTC_ERROR_NONE)
    throw std::runtime_error(
        fmt::format("Embree could not build the scene (error {})", static_cast<int>(error)));
  impl_ = std::move(impl);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<Hit> RayScene::intersect(const Vec3& origin, const Vec3& normal, const Vec3& direction) const {
  RTCRayHit query{};
  query.ray =
      make_ray(leave_surface(origin, normal), to_float(direction), std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  trace(impl_->scene.get(), query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  // From the barycentric coordinates the point lies in the triangle's plane to rounding, however long the
  // ray.
  const TriangleMesh& mesh = impl_->mesh;
  const auto& [a, b, c] = mesh.triangles[query.hit.primID];
  const Vec3 p0 = mesh.vertices[a], e1 = mesh.vertices[b] - p0, e2 = mesh.vertices[c] - p0;
  const Vec3 n = normalized(cross(e1, e2));
  return Hit{p0 + e1 * static_cast<double>(query.hit.u) + e2 * static_cast<double>(query.hit.v),
             dot(n, direction) > 0 ? -n : n, mesh.materials[query.hit.primID]};
}

bool RayScene::occluded(const Vec3& origin, const Vec3& normal, const Vec3& target) const {
  const Float3 from = leave_surface(origin, normal), to = to_float(target);
  RTCRay ray = make_ray(from, {to.x - from.x, to.y - from.y, to.z - from.z}, shadow_end);
  trace(impl_->scene.get(), ray);
  return ray.tfar < 0;
}

}  // namespace shelfbeam
