#include "random_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam::bench {

namespace {

class Places {
 public:
  Places(const World& world, std::uint64_t seed) : world_(world), random_(seed, 0, 0, 0) {}

  /// Nothing if the place that was drawn is not free.
  std::optional<Transceiver> draw(std::size_t place) {
    Transceiver unit = any_of(world_.scene.transceivers);
    unit.installed = unit.pinned = false;
    unit.relative_power = 1;
    if (place < 2) return near_candidate(unit, place == 1);
    return place == 2 ? beside_wall(unit) : between_shelves(unit);
  }

 private:
  template <class Thing>
  const Thing& any_of(const std::vector<Thing>& things) {
    return things[to_index(random_.bits(), static_cast<std::uint32_t>(things.size()))];
  }
  double between(double low, double high) { return low + (high - low) * random_.uniform(); }
  double free_way(const SurfacePoint& from, const Vec3& direction) const {
    const auto hit = world_.rays.intersect(from, direction);
    return hit ? hit->distance(from.position, direction) : std::numeric_limits<double>::infinity();
  }

  std::optional<Transceiver> near_candidate(Transceiver unit, bool is_tilted) {
    const Vec3 way{between(-1, 1), between(-1, 1), 0};
    const double turn = between(0, 2 * pi), margin = 0.1;
    if (free_way({unit.position, unit.axis}, normalized(way)) < length(way) + margin) return std::nullopt;
    unit.position = unit.position + way;
    if (is_tilted)
      unit.axis = normalized(unit.axis * std::cos(pi / 6) +
                             Vec3{std::cos(turn), std::sin(turn), 0} * std::sin(pi / 6));
    return unit;
  }

  std::optional<Transceiver> beside_wall(Transceiver unit) {
    const double turn = pi / 2 * to_index(random_.bits(), 4);
    const Vec3 out{std::cos(turn), std::sin(turn), 0};
    const auto hit = world_.rays.intersect({unit.position, unit.axis}, out);
    if (!hit) return std::nullopt;
    unit.position = hit->point.position - out * between(0.1, 0.2);
    unit.position.z -= between(0, 0.5);
    unit.axis = normalized(Vec3{0, 0, -1} - out * between(0, 1));
    return unit;
  }

  std::optional<Transceiver> between_shelves(Transceiver unit) {
    const Label& label = any_of(world_.scene.labels);
    const double ahead = free_way({label.position, label.normal}, label.normal), margin = 0.2;
    if (ahead < 2 * margin) return std::nullopt;
    unit.position = label.position + label.normal * std::min(ahead / 2, 1.0);
    const double height = between(1, 2.2), rise = height - unit.position.z;
    const Vec3 up{0, 0, rise > 0 ? 1.0 : -1.0};
    if (free_way({unit.position, label.normal}, up) < std::abs(rise) + margin) return std::nullopt;
    unit.position.z = height;
    if (free_way({unit.position, label.normal}, label.normal) < margin) return std::nullopt;
    return unit;
  }

  const World& world_;
  RandomStream random_;
};

}  // namespace

std::vector<PlacedUnit> random_units(const World& world, std::size_t count, std::uint64_t seed) {
  Places places(world, seed);
  constexpr std::size_t max_tries = 1000;  // per unit
  std::vector<PlacedUnit> units;
  for (std::size_t tries = 0; units.size() < count; ++tries) {
    if (world.scene.transceivers.empty() || world.scene.labels.empty() || tries > max_tries * count)
      throw std::invalid_argument("the store has no free place for some kind of unit");
    const std::size_t place = units.size() % unit_places.size();
    auto unit = places.draw(place);
    if (!unit) continue;
    unit->id = fmt::format("{} {}", unit_places[place], units.size());
    units.push_back({place, std::move(*unit)});
  }
  return units;
}

}  // namespace shelfbeam::bench
