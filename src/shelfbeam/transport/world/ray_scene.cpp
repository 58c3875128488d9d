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

#include "shelfbeam/transport/world/contacts.hpp"
#include "shelfbeam/transport/world/extent.hpp"

namespace shelfbeam {

namespace {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

// Surfaces within this reach of glass are ordered by Contacts: in multiples of the rounding error of rays,
// and at least.
constexpr double reach_steps = 200, min_reach = 5e-5;  // m

using Stack = std::vector<Contacts::Crossing>;

Stack::const_iterator find(const Stack& stack, std::uint32_t triangle) {
  return std::find_if(stack.begin(), stack.end(),
                      [&](const auto& crossing) { return crossing.triangle == triangle; });
}

struct Float3 {
  float x, y, z;
};

Float3 to_float(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
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
    return {corner + edge1 * u + edge2 * v, normalized(cross(edge1, edge2)), number};
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

EmbreeScene build(RTCDevice device, const TriangleMesh& mesh, const Vec3& centre,
                  const std::vector<Triangle>& chosen) {
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
    const Float3 v = to_float(vertex - centre);
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
  Vec3 centre;      // of the coordinates of Embree
  double step = 0;  // distance from a surface at which rays start, m
  double end = 0;   // distance before a point at which rays end, m
  Contacts contacts;
  Device device = {};
  std::vector<std::optional<Material>> pane = {};  // by material
  TriangleSet opaque = {}, panes = {};             // `panes` has no Embree scene if it is empty

  Float3 leave(const SurfacePoint& from, const Vec3& direction) const {
    return to_float(from.position - centre + from.normal * std::copysign(step, dot(from.normal, direction)));
  }

  // A ray that ends slightly before a point.
  RTCRay ray_to(const SurfacePoint& from, const Vec3& to) const {
    const Float3 target = to_float(to - centre);
    const Vec3 way = to - from.position;
    const Float3 origin = leave(from, way);
    RTCRay ray{};
    aim(ray, origin, {target.x - origin.x, target.y - origin.y, target.z - origin.z},
        static_cast<float>(std::max(0.0, 1 - end / length(way))));
    return ray;
  }

  // The first surface on a ray, of both sets. Shortens the ray.
  std::optional<Hit> first_on(RTCRayHit& ray) const {
    const Triangle* triangle = opaque.cut(ray) ? &opaque.hit_by(ray) : nullptr;
    float u = ray.hit.u, v = ray.hit.v;
    if (panes.scene && panes.cut(ray)) {
      triangle = &panes.hit_by(ray);
      u = ray.hit.u;
      v = ray.hit.v;
    }
    if (triangle == nullptr) return std::nullopt;
    return Hit{triangle->point(static_cast<double>(u), static_cast<double>(v)), triangle->material};
  }

  PaneShares pane_shares_of(MaterialId glass, double cosine) const {
    return pane_shares(*pane[glass.value], cosine);
  }

  template <class Point>
  bool is_stacked(const Point& point) const {
    return contacts.contain(point.triangle, point.position);
  }

  Hit hit_at(const Contacts::Crossing& crossing, const Vec3& from, const Vec3& direction) const {
    return {{from + direction * crossing.distance, contacts.normal(crossing.triangle), crossing.triangle},
            contacts.material(crossing.triangle)};
  }

  // The surface of a stack that light meets first, if a ray has met one of them. The surfaces `behind` have
  // been passed.
  Hit enter_stack(const Hit& hit, const Vec3& from, const Vec3& direction, const Stack& behind) const {
    const double distance = dot(hit.point.position - from, direction);
    for (const Contacts::Crossing& crossing :
         contacts.stack(hit.point.triangle, hit.point.position, direction)) {
      if (crossing.triangle == hit.point.triangle) break;
      if (distance + crossing.distance > 0 && find(behind, crossing.triangle) == behind.end())
        return hit_at(crossing, hit.point.position, direction);
    }
    return hit;
  }

  // The next surface for light that leaves a surface of a stack: in the stack, or beyond it.
  std::optional<Hit> leave_stack(const SurfacePoint& from, const Vec3& direction, RTCRayHit& ray) const {
    Stack behind = contacts.stack(from.triangle, from.position, direction);
    const auto next = find(behind, from.triangle) + 1;
    // Nothing else lies between surfaces that are nearer than the offset of rays.
    if (next != behind.end() && next->distance * std::abs(dot(from.normal, direction)) < 2 * step)
      return hit_at(*next, from.position, direction);
    behind.erase(next, behind.end());
    auto hit = first_on(ray);
    while (hit && find(behind, hit->point.triangle) != behind.end()) {
      ray.ray.tnear = std::nextafter(ray.ray.tfar, std::numeric_limits<float>::infinity());
      ray.ray.tfar = std::numeric_limits<float>::infinity();
      hit = first_on(ray);
    }
    if (hit && is_stacked(hit->point)) return enter_stack(*hit, from.position, direction, behind);
    return hit;
  }
};

RayScene::RayScene(const Scene& scene, double enlargement) {
  const RayCoordinates coordinates = ray_coordinates(scene);
  auto impl = std::make_unique<Impl>(Impl{
      .centre = coordinates.centre,
      .step = coordinates.start(),
      .end = coordinates.end(),
      .contacts = Contacts(scene, {std::max(min_reach * enlargement, reach_steps * coordinates.rounding()),
                                   max_overlap * enlargement})});
  end_ = impl->end;
  for (const auto& [name, material, range] : scene.materials)
    impl->pane.push_back(is_pane(material) ? std::optional(material) : std::nullopt);
  impl->device.reset(rtcNewDevice(nullptr));
  // With little memory, Embree reports various errors.
  if (!impl->device && rtcGetDeviceError(nullptr) != RTC_ERROR_UNSUPPORTED_CPU) throw std::bad_alloc();
  if (!impl->device) throw std::runtime_error("Embree does not support this processor");
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t)
    (impl->pane[scene.mesh.materials[t].value] ? impl->panes : impl->opaque).add(scene.mesh, t);
  impl->opaque.scene = build(impl->device.get(), scene.mesh, impl->centre, impl->opaque.triangles);
  if (!impl->panes.triangles.empty())
    impl->panes.scene = build(impl->device.get(), scene.mesh, impl->centre, impl->panes.triangles);
  impl_ = std::move(impl);
}

RayScene::~RayScene() = default;

std::optional<Hit> RayScene::intersect(const SurfacePoint& from, const Vec3& direction) const {
  RTCRayHit ray{};
  aim(ray.ray, impl_->leave(from, direction), to_float(direction), std::numeric_limits<float>::infinity());
  if (impl_->is_stacked(from)) return impl_->leave_stack(from, direction, ray);
  const auto hit = impl_->first_on(ray);
  if (!hit || !impl_->is_stacked(hit->point)) return hit;
  return impl_->enter_stack(*hit, from.position, direction, {});
}

bool RayScene::has_contact(const SurfacePoint& point) const {
  return impl_->is_stacked(point);
}

Transmittance RayScene::transmittance(const SurfacePoint& from, const RayEnd& to) const {
  if (impl_->is_stacked(from) || impl_->is_stacked(to)) return in_order(from, to);
  RTCRay shadow = impl_->ray_to(from, to.position);
  trace(impl_->opaque.scene.get(), shadow);
  if (shadow.tfar < 0) return {0, 0};
  return impl_->panes.scene ? through_panes(from, to) : Transmittance{};
}

void RayScene::transmittances(const SurfacePoint& from, std::span<const RayEnd> to,
                              std::span<Transmittance> result) const {
  each_transmittance(from, to,
                     [&](std::size_t k, const Transmittance& transmittance) { result[k] = transmittance; });
}

void RayScene::shares(const SurfacePoint& from, std::span<const RayEnd> to, std::span<float> result) const {
  each_transmittance(from, to, [&](std::size_t k, const Transmittance& transmittance) {
    result[k] = static_cast<float>(transmittance.share);
  });
}

template <class Use>
void RayScene::each_transmittance(const SurfacePoint& from, std::span<const RayEnd> to,
                                  const Use& use) const {
  constexpr std::size_t width = 16;
  const bool leaves_stack = impl_->is_stacked(from);
  for (std::size_t first = 0; first < to.size(); first += width) {
    const std::size_t count = std::min(width, to.size() - first);
    alignas(64) RTCRay16 rays{};
    alignas(64) int valid[width];
    bool is_stacked[width];
    for (std::size_t k = 0; k < width; ++k) {
      const RayEnd& end = to[first + std::min(k, count - 1)];
      is_stacked[k] = leaves_stack || impl_->is_stacked(end);
      valid[k] = k < count && !is_stacked[k] ? -1 : 0;
      const RTCRay ray = impl_->ray_to(from, end.position);
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
      use(first + k, is_stacked[k]      ? in_order(from, to[first + k])
                     : is_blocked[k]    ? Transmittance{0, 0}
                     : rays.tfar[k] < 0 ? through_panes(from, to[first + k])
                                        : Transmittance{});
  }
}

Transmittance RayScene::through_panes(const SurfacePoint& from, const RayEnd& to) const {
  const Vec3 direction = normalized(to.position - from.position);
  Transmittance transmittance;
  for (SurfacePoint at = from; transmittance.share > 0;) {
    RTCRayHit ray{impl_->ray_to(at, to.position), {}};
    if (!impl_->panes.cut(ray)) break;
    const Triangle& pane = impl_->panes.hit_by(ray);
    at = pane.point(static_cast<double>(ray.hit.u), static_cast<double>(ray.hit.v));
    if (impl_->is_stacked(at)) return in_order(from, to);
    if (dot(to.position - at.position, direction) <= 0) break;
    transmittance.pass(impl_->pane_shares_of(pane.material, dot(at.normal, direction)));
  }
  return transmittance;
}

// The transmittance of a connection that meets a stack, surface by surface.
Transmittance RayScene::in_order(const SurfacePoint& from, const RayEnd& to) const {
  const Vec3 direction = normalized(to.position - from.position);
  Transmittance transmittance;
  SurfacePoint at = from;
  while (transmittance.share > 0) {
    const auto hit = intersect(at, direction);
    if (!hit || to.triangle == hit->point.triangle) break;
    const double remaining = dot(to.position - hit->point.position, direction);
    // Surfaces near the end do not count unless they are in contact with its surface.
    const bool is_before =
        remaining > -2 * end_ && impl_->contacts.are_partners(to.triangle, hit->point.triangle);
    if (remaining <= end_ && !is_before) break;
    if (!impl_->pane[hit->material.value]) return {0, 0};
    at = hit->point;
    transmittance.pass(impl_->pane_shares_of(hit->material, dot(at.normal, direction)));
  }
  return transmittance;
}

}  // namespace shelfbeam
