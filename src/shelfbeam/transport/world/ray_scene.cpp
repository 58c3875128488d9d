#include "shelfbeam/transport/world/ray_scene.hpp"

#if SHELFBEAM_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
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

// Single-precision rounding error of a coordinate, relative to the largest coordinate.
constexpr double rounding = 1.0 / (1 << 24);
// Offsets of rays in multiples of this error: at the start from a surface, and at the end from the target,
// whose surface a ray may meet at a grazing angle. A quarter of either suffices in all tests.
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
void trace(RTCScene scene, const int* valid, RTCRay16& rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
}
#else
void trace(RTCScene scene, RTCRayHit& ray) {
  rtcIntersect1(scene, &ray);
}
void trace(RTCScene scene, RTCRay& ray) {
  rtcOccluded1(scene, &ray);
}
void trace(RTCScene scene, const int* valid, RTCRay16& rays) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &rays, &arguments);
}
#endif

void aim(RTCRay& ray, const Float3& origin, const Float3& direction, float end) {
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = end;
  ray.mask = std::numeric_limits<unsigned>::max();
}

struct Triangle {
  Vec3 corner, edge1, edge2;
  MaterialId material;
  std::uint32_t number;  // index in the mesh

  // Barycentric coordinates give a point in the triangle's plane to rounding, however long the ray is.
  SurfacePoint point(double u, double v) const {
    return {corner + edge1 * u + edge2 * v, normalized(cross(edge1, edge2))};
  }
};

// Triangles of one kind in an Embree scene of their own. Ray masks could separate the kinds, but not every
// package of Embree is built with them.
struct TriangleSet {
  std::vector<Triangle> triangles;  // by Embree's primID
  EmbreeScene scene;

  void add(const TriangleMesh& mesh, std::uint32_t number) {
    const auto& [a, b, c] = mesh.triangles[number];
    const Vec3 corner = mesh.vertices[a];
    triangles.push_back(
        {corner, mesh.vertices[b] - corner, mesh.vertices[c] - corner, mesh.materials[number], number});
  }

  const Triangle& hit_by(const RTCRayHit& ray) const { return triangles[ray.hit.primID]; }

  // Shortens the ray to its first hit in this set; false if it hits nothing.
  bool cut(RTCRayHit& ray) const {
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    trace(scene.get(), ray);
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
};

// Embree aborts the process when a scene is released for which the memory did not suffice.
[[noreturn]] void give_up(EmbreeScene scene) {
  static_cast<void>(scene.release());
  throw std::bad_alloc();
}

EmbreeScene build(RTCDevice device, const TriangleMesh& mesh, const std::vector<Triangle>& chosen) {
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
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), chosen.size()));
  if (vertices == nullptr || indices == nullptr) give_up(std::move(scene));
  for (const Vec3& vertex : mesh.vertices) {
    const Float3 v = to_float(vertex);
    *vertices++ = v.x;
    *vertices++ = v.y;
    *vertices++ = v.z;
  }
  for (const Triangle& triangle : chosen)
    for (const std::uint32_t corner : mesh.triangles[triangle.number]) *indices++ = corner;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  const RTCError error = rtcGetDeviceError(device);
  // A failed allocation is often reported as an unknown error.
  if (error == RTC_ERROR_OUT_OF_MEMORY || error == RTC_ERROR_UNKNOWN) give_up(std::move(scene));
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(
        fmt::format("Embree could not build the scene (error {})", static_cast<int>(error)));
  return scene;
}

}  // namespace

struct RayScene::Impl {
  Device device;
  std::vector<std::optional<ThinDielectric>> pane;  // by material
  TriangleSet opaque, panes;                        // `panes` has no Embree scene if it is empty
  double step = 0;                                  // distance from a surface at which rays start, m
  double end = 0;                                   // distance before a point at which rays end, m

  Float3 leave(const SurfacePoint& from, const Vec3& direction) const {
    return to_float(from.position + from.normal * std::copysign(step, dot(from.normal, direction)));
  }

  // A ray that ends slightly before a point.
  RTCRay ray_to(const SurfacePoint& from, const Vec3& to) const {
    const Float3 target = to_float(to);
    const Vec3 way = to - from.position;
    const Float3 origin = leave(from, way);
    RTCRay ray{};
    aim(ray, origin, {target.x - origin.x, target.y - origin.y, target.z - origin.z},
        static_cast<float>(std::max(0.0, 1 - end / length(way))));
    return ray;
  }
};

RayScene::RayScene(const Scene& scene) {
  auto impl = std::make_unique<Impl>();
  const double unit = rounding * largest_coordinate(scene);
  impl->step = steps * unit;
  impl->end = end_ = end_steps * unit;
  for (const NamedMaterial& named : scene.materials) {
    const auto* pane = std::get_if<ThinDielectric>(&named.material);
    impl->pane.push_back(pane != nullptr ? std::optional(*pane) : std::nullopt);
  }
  impl->device.reset(rtcNewDevice(nullptr));
  // With little memory, Embree reports various errors.
  if (!impl->device && rtcGetDeviceError(nullptr) != RTC_ERROR_UNSUPPORTED_CPU) throw std::bad_alloc();
  if (!impl->device) throw std::runtime_error("Embree does not support this processor");
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t)
    (impl->pane[scene.mesh.materials[t].value] ? impl->panes : impl->opaque).add(scene.mesh, t);
  impl->opaque.scene = build(impl->device.get(), scene.mesh, impl->opaque.triangles);
  if (!impl->panes.triangles.empty())
    impl->panes.scene = build(impl->device.get(), scene.mesh, impl->panes.triangles);
  impl_ = std::move(impl);
}

RayScene::~RayScene() = default;

std::optional<Hit> RayScene::intersect(const SurfacePoint& from, const Vec3& direction) const {
  RTCRayHit ray{};
  aim(ray.ray, impl_->leave(from, direction), to_float(direction), std::numeric_limits<float>::infinity());
  const Triangle* triangle = impl_->opaque.cut(ray) ? &impl_->opaque.hit_by(ray) : nullptr;
  float u = ray.hit.u, v = ray.hit.v;
  if (impl_->panes.scene && impl_->panes.cut(ray)) {
    triangle = &impl_->panes.hit_by(ray);
    u = ray.hit.u;
    v = ray.hit.v;
  }
  if (triangle == nullptr) return std::nullopt;
  return Hit{triangle->point(static_cast<double>(u), static_cast<double>(v)), triangle->material,
             triangle->number};
}

Transmittance RayScene::transmittance(const SurfacePoint& from, const Vec3& to) const {
  RTCRay shadow = impl_->ray_to(from, to);
  trace(impl_->opaque.scene.get(), shadow);
  if (shadow.tfar < 0) return {0, 0};
  return impl_->panes.scene ? through_panes(from, to) : Transmittance{};
}

void RayScene::transmittances(const SurfacePoint& from, std::span<const Vec3> to,
                              std::span<Transmittance> result) const {
  each_transmittance(from, to,
                     [&](std::size_t k, const Transmittance& transmittance) { result[k] = transmittance; });
}

void RayScene::shares(const SurfacePoint& from, std::span<const Vec3> to, std::span<float> result) const {
  each_transmittance(from, to, [&](std::size_t k, const Transmittance& transmittance) {
    result[k] = static_cast<float>(transmittance.share);
  });
}

template <class Use>
void RayScene::each_transmittance(const SurfacePoint& from, std::span<const Vec3> to, const Use& use) const {
  constexpr std::size_t width = 16;
  for (std::size_t first = 0; first < to.size(); first += width) {
    const std::size_t count = std::min(width, to.size() - first);
    alignas(64) RTCRay16 rays{};
    alignas(64) int valid[width];
    for (std::size_t k = 0; k < width; ++k) {
      valid[k] = k < count ? -1 : 0;
      const RTCRay ray = impl_->ray_to(from, to[first + std::min(k, count - 1)]);
      rays.org_x[k] = ray.org_x;
      rays.org_y[k] = ray.org_y;
      rays.org_z[k] = ray.org_z;
      rays.dir_x[k] = ray.dir_x;
      rays.dir_y[k] = ray.dir_y;
      rays.dir_z[k] = ray.dir_z;
      rays.tfar[k] = ray.tfar;
      rays.mask[k] = ray.mask;
    }
    trace(impl_->opaque.scene.get(), valid, rays);
    bool is_blocked[width];
    for (std::size_t k = 0; k < count; ++k) {
      is_blocked[k] = rays.tfar[k] < 0;
      if (is_blocked[k]) valid[k] = 0;
    }
    if (impl_->panes.scene) trace(impl_->panes.scene.get(), valid, rays);
    for (std::size_t k = 0; k < count; ++k)
      use(first + k, is_blocked[k]      ? Transmittance{0, 0}
                     : rays.tfar[k] < 0 ? through_panes(from, to[first + k])
                                        : Transmittance{});
  }
}

Transmittance RayScene::through_panes(const SurfacePoint& from, const Vec3& to) const {
  const Vec3 direction = normalized(to - from.position);
  Transmittance transmittance;
  for (SurfacePoint at = from; transmittance.share > 0;) {
    RTCRayHit ray{impl_->ray_to(at, to), {}};
    if (!impl_->panes.cut(ray)) break;
    const Triangle& pane = impl_->panes.hit_by(ray);
    at = pane.point(static_cast<double>(ray.hit.u), static_cast<double>(ray.hit.v));
    if (dot(to - at.position, direction) <= 0) break;
    const auto [reflected, transmitted] =
        pane_shares(*impl_->pane[pane.material.value], dot(at.normal, direction));
    transmittance.share *= transmitted;
    transmittance.probability *= transmitted > 0 ? transmitted / (reflected + transmitted) : 0;
  }
  return transmittance;
}

}  // namespace shelfbeam
