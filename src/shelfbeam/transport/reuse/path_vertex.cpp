#include "shelfbeam/transport/reuse/path_vertex.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

PathVertex::PathVertex(const World& world, const RadianceCache& cache, const ChainEnd& where)
    : end(where),
      row(cache.row(where.point)),
      material(&world.scene.materials[where.material.value].material),
      guide(&cache.guide(where.material)) {
  const double flat = static_cast<double>(guide->flat()) * pi;
  if (!has_base()) own_albedo = flat;
  if (guide->is_detailed()) {
    const double cosine = dot(end.point.normal, end.outgoing);
    exit = guide->exit(cosine);
    scatter = guide->towards(end.outgoing, end.point.normal, exit);
    if (has_base() && guide->has_highlight()) own_albedo = 1 - exit;
  }
  albedo = has_base() ? exit * guide->base_albedo() + (1 - exit) : flat;
}

double PathVertex::exit_towards(const Vec3& position) const {
  return guide->exit_towards(end.point, position);
}

PathVertex::Reflection PathVertex::reflected(const Vec3& to_source) const {
  const double cosine = dot(end.point.normal, to_source);
  Reflection result;
  if (has_base() && cosine > 0) result.base = guide->base(cosine) * cosine;
  if (has_base() && !guide->has_highlight()) {
    result.whole = exit * result.base;
  } else {
    const Frame frame = Frame::of_surface(end.outside);
    const Vec3 incoming = frame.to_local(to_source);
    result.whole = eval(*material, frame.to_local(end.outgoing), incoming) * std::abs(incoming.z);
  }
  return result;
}

PathVertex::Parts PathVertex::split(const Reflection& straight, const DirectSignal& signal) const {
  if (!has_base()) return {{}, signal};
  if (!guide->is_detailed()) return {signal, {}};
  Parts parts{{}, signal};
  parts.own.straight = 0;
  if (signal.straight > 0) {
    parts.base.straight = signal.straight * straight.base / straight.whole;
    if (guide->has_highlight()) parts.own.straight = signal.straight - exit * parts.base.straight;
  }
  return parts;
}

PathVertex::Scattered PathVertex::scatter_by_base(double u1, double u2) const {
  const Vec3 local = sample_cosine_hemisphere(u1, u2);
  return {Frame::about(end.point.normal).to_world(local), pi * guide->base(local.z), Departure::scattered};
}

std::optional<PathVertex::Scattered> PathVertex::scatter_otherwise(double u_lobe, double u1,
                                                                   double u2) const {
  const auto* const plastic = std::get_if<Plastic>(material);
  const Frame frame = plastic != nullptr ? Frame::about(end.point.normal) : Frame::of_surface(end.outside);
  const Vec3 outgoing = frame.to_local(end.outgoing);
  const auto drawn = plastic != nullptr ? plastic->sample_coat(outgoing, u1, u2)
                                        : sample(*material, outgoing, u_lobe, u1, u2);
  if (!drawn || drawn->weight == 0) return std::nullopt;
  const Departure departure =
      drawn->specular ? after_specular(end.arrived, end.is_imaged) : Departure::scattered;
  return Scattered{frame.to_world(drawn->direction), drawn->weight, departure};
}

PathVertex::Guided PathVertex::guided(const UnitGroups& units, std::size_t g, std::size_t lane,
                                      const LanePoint& point) const {
  if (guide->is_detailed()) {
    const LaneKernels::Parts parts = LaneKernels::parts(units, g, lane, point, scatter);
    return {static_cast<float>(guide->bare_base()) * parts.entry, parts.highlight};
  }
  return has_base() ? Guided{guide->flat(), 0} : Guided{0, guide->flat()};
}

void PathVertex::look_up(const UnitGroups& units, float weight, LaneRow& to) const {
  to.use(row.groups, row.count);
  const LanePoint point(end.point);
  if (guide->is_detailed()) {
    const auto indirect = static_cast<float>((exit * guide->base_albedo() + own_albedo) / pi);
    LaneKernels::add_radiance(units, row.groups, row.count, point, scatter, is_capped, weight, indirect,
                              row.share, row.indirect, to.mutable_values());
  } else {
    LaneKernels::add_irradiance(units, row.groups, row.count, point, is_capped, weight * guide->flat(),
                                row.share, row.indirect, to.mutable_values());
  }
}

}  // namespace shelfbeam
