#include "shelfbeam/transport/cache/unit_groups.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "shelfbeam/transport/cache/lane_kernels.hpp"

namespace shelfbeam {

namespace {

// Halves a list of units across the longest side of their bounding box until at most sixteen are left. The
// size of the first half is a multiple of sixteen, so that few lanes stay empty.
void split(const std::vector<Transceiver>& units, std::vector<std::uint32_t>::iterator first,
           std::vector<std::uint32_t>::iterator last, std::vector<std::vector<std::uint32_t>>& leaves) {
  const auto count = static_cast<std::size_t>(last - first);
  if (count <= lanes) {
    leaves.emplace_back(first, last);
    return;
  }
  int widest = 0;
  double most = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(first, last, [&](std::uint32_t a, std::uint32_t b) {
      return units[a].position[axis] < units[b].position[axis];
    });
    const double width = units[*high].position[axis] - units[*low].position[axis];
    if (width > most) {
      most = width;
      widest = axis;
    }
  }
  const std::size_t half = (count / 2 + lanes - 1) / lanes * lanes;
  const auto middle = first + static_cast<std::ptrdiff_t>(half);
  std::stable_sort(first, last, [&](std::uint32_t a, std::uint32_t b) {
    return units[a].position[widest] < units[b].position[widest];
  });
  split(units, first, middle, leaves);
  split(units, middle, last, leaves);
}

}  // namespace

UnitGroups::UnitGroups(const World& world) {
  const Scene& scene = world.scene;
  for (std::uint32_t type = 0; type < scene.transceiver_types.size(); ++type) {
    const TransceiverType& kind = scene.transceiver_types[type];
    std::vector<std::uint32_t> members;
    for (std::uint32_t j = 0; j < scene.transceivers.size(); ++j)
      if (scene.transceivers[j].type.value == type) members.push_back(j);
    if (members.empty()) continue;

    Group pattern;
    float scale = 1, peak = 0;
    pattern.is_approximate = kind.radius > 0;
    const auto* lambertian = std::get_if<GeneralizedLambertian>(&kind.emission);
    if (const auto* sine = std::get_if<SinTwoTheta>(&kind.emission)) {
      pattern.profile = LaneProfile::sine;
      scale = peak = static_cast<float>(sine->peak);
    } else if (const auto* isotropic = std::get_if<IsotropicHemisphere>(&kind.emission)) {
      pattern.profile = LaneProfile::isotropic;
      scale = peak = static_cast<float>(isotropic->intensity);
    } else if (lambertian != nullptr && lambertian->order == 1) {
      pattern.profile = LaneProfile::lambertian;
      scale = peak = static_cast<float>(mean_intensity(kind.emission, 0));
    } else {
      pattern.table = static_cast<std::uint32_t>(tables_.size());
      pattern.is_approximate = true;
      for (int k = 0; k <= table_steps; ++k) {
        const double cosine = std::clamp(2.0 * k / table_steps - 1, -1.0, 1.0);
        tables_.push_back(static_cast<float>(mean_intensity(kind.emission, std::acos(cosine))));
        peak = std::max(peak, tables_.back());
      }
    }

    std::vector<std::vector<std::uint32_t>> leaves;
    split(scene.transceivers, members.begin(), members.end(), leaves);
    for (std::vector<std::uint32_t>& leaf : leaves) {
      std::sort(leaf.begin(), leaf.end());
      Group group = pattern;
      group.count = leaf.size();
      for (std::size_t k = 0; k < lanes; ++k) group.columns[k] = leaf[std::min(k, leaf.size() - 1)];
      group.type_scale = scale;
      group.type_peak = peak;
      place(group, scene);
      groups_.push_back(group);
    }
  }
  const std::size_t n_units = scene.transceivers.size();
  for (std::size_t first = n_units; first < world.emitters.size(); first += lanes) {
    Group group;
    group.profile = LaneProfile::isotropic;
    group.count = std::min(lanes, world.emitters.size() - first);
    for (std::size_t k = 0; k < lanes; ++k)
      group.columns[k] = static_cast<std::uint32_t>(first + std::min(k, group.count - 1));
    group.nearest = 1;
    groups_.push_back(group);
  }
  no_cap_.fill(std::numeric_limits<float>::max());
  for (Group& group : groups_) group.cap = no_cap_;
  lane_indices_.resize(world.emitters.size());
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (std::size_t k = 0; k < groups_[g].count; ++k)
      lane_indices_[groups_[g].columns[k]] = static_cast<std::uint32_t>(g * lanes + k);
}

UnitGroups::UnitGroups(const World& changed, const UnitGroups& like)
    : groups_(like.groups_), no_cap_(like.no_cap_), lane_indices_(like.lane_indices_), tables_(like.tables_) {
  for (Group& group : groups_) {
    group.cap = no_cap_;
    if (group.columns.front() < changed.scene.transceivers.size()) place(group, changed.scene);
  }
}

// Sets everything that depends on the units besides their type.
void UnitGroups::place(Group& group, const Scene& scene) {
  Vec3 centre;
  group.peak = 0;
  for (std::size_t k = 0; k < lanes; ++k) {
    const Transceiver& unit = scene.transceivers[group.columns[k]];
    group.x[k] = static_cast<float>(unit.position.x);
    group.y[k] = static_cast<float>(unit.position.y);
    group.z[k] = static_cast<float>(unit.position.z);
    group.ax[k] = static_cast<float>(unit.axis.x);
    group.ay[k] = static_cast<float>(unit.axis.y);
    group.az[k] = static_cast<float>(unit.axis.z);
    const auto power = static_cast<float>(unit.relative_power);
    group.scale[k] = k < group.count ? group.type_scale * power : 0;
    group.peak = std::max(group.peak, group.type_peak * power);
    if (k < group.count) centre = centre + unit.position / static_cast<double>(group.count);
  }
  group.radius = 0;
  for (std::size_t k = 0; k < group.count; ++k)
    group.radius = std::max(
        group.radius, static_cast<float>(length(scene.transceivers[group.columns[k]].position - centre)));
  group.centre = {static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z)};
  group.nearest = std::max(0.5F, group.radius / 2);
}

void UnitGroups::set_cap(std::size_t column, float cap) {
  groups_[lane_indices_[column] / lanes].cap[lane_indices_[column] % lanes] = cap;
}

void UnitGroups::irradiance(std::size_t g, const LanePoint& point, LaneValues& result) const {
  LaneKernels::irradiance(*this, g, point, result);
}

}  // namespace shelfbeam
