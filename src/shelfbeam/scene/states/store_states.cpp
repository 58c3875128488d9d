#include "shelfbeam/scene/states/store_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/fixture/turn.hpp"
#include "shelfbeam/scene/states/draws.hpp"

namespace shelfbeam {

namespace {

double share_open(const StoreVariation& variation, const Shelving& shelves) {
  if (!shelves.doors) return 0;
  if (shelves.variation.open) return *shelves.variation.open;
  double open = variation.open_doors;
  for (const OpenDoors& doors : variation.doors)
    if (matches_glob(shelves.id, doors.fixtures)) open = doors.open;
  return open;
}

// By inversion: the smallest n with P(N <= n) > u.
std::int64_t poisson(double mean, double u) {
  double probability = std::exp(-mean), sum = probability;
  std::int64_t n = 0;
  const auto most = static_cast<std::int64_t>(mean + 20 * std::sqrt(mean) + 20);
  while (sum <= u && n < most) {
    ++n;
    probability *= mean / static_cast<double>(n);
    sum += probability;
  }
  return n;
}

std::int64_t number_of(const StandingBoxes& boxes, double u) {
  if (const auto* poisson_number = std::get_if<PoissonNumber>(&boxes.number))
    return poisson(poisson_number->mean, u);
  if (const auto* ends = std::get_if<UniformNumber>(&boxes.number))
    return ends->low + static_cast<std::int64_t>(u * static_cast<double>(ends->high - ends->low + 1));
  return u < std::get<Presence>(boxes.number).probability ? 1 : 0;
}

double decibels(double value) {
  return std::pow(10, value / 10);
}

}  // namespace

/// One state in the making.
class StoreStates::Drawing {
 public:
  Drawing(const StoreStates& states, const StateNumbers& numbers, const Scene& devices)
      : states_(states),
        devices_(devices),
        variation_(*states.store_.variation),
        numbers_(numbers),
        state_(states.store_),
        where_(state_.file + ": state"),
        taken_(states.floor_) {
    if (const auto k = numbers.of(Cause::stock)) where_ += fmt::format(" {}", *k);
  }

  Store drawn() {
    state_.variation.reset();
    if (const auto k = numbers_.of(Cause::stock); k && !state_.name.empty())
      state_.name += fmt::format(", state {}", *k);
    list_devices();
    for (std::size_t f = 0; f < state_.fixtures.size(); ++f)
      vary(state_.fixtures[f].value, states_.open_doors_[f]);
    for (const StandingBoxes& boxes : variation_.boxes)
      if (varies(boxes.is_person ? Cause::people : Cause::objects)) stand(boxes);
    return std::move(state_);
  }

 private:
  bool varies(Cause cause) const { return numbers_.of(cause).has_value() && variation_.varies(cause); }
  Draws draws(Cause cause, std::string_view kind, std::string_view id) const {
    return Draws(states_.seed_, *numbers_.of(cause), fmt::format("{}/{}", kind, id));
  }

  void list_devices() {
    state_.labels.clear();
    state_.measuring_planes.clear();
    for (const Label& label : devices_.labels) {
      expect_running(state_.cancel);
      state_.labels.push_back({label, where_});
      if (varies(Cause::labels) && variation_.label_sensitivity_db > 0)
        state_.labels.back().value.relative_sensitivity *=
            factor(variation_.label_sensitivity_db, draws(Cause::labels, "label", label.id));
    }
    clear_units(state_);
    for (Transceiver unit : devices_.transceivers) {
      expect_running(state_.cancel);
      if (varies(Cause::mounting)) move(unit);
      if (unit.installed) state_.installed.push_back({unit.id, where_});
      state_.transceivers.push_back({std::move(unit), where_});
    }
  }

  static double factor(double sigma_db, const Draws& draws) {
    return rounded(std::clamp(decibels(sigma_db * draws.normal(0)), 0.01, 100.0), 1e6);
  }

  // Options of a mounting point move together, horizontally.
  void move(Transceiver& unit) const {
    const auto& [px, py, pz] = unit.position;
    const std::string mount = fmt::format("{:.4f} {:.4f} {:.4f}", px, py, pz);
    if (variation_.unit_power_db > 0)
      unit.relative_power *= factor(variation_.unit_power_db, draws(Cause::mounting, "power", mount));
    const Draws draws = this->draws(Cause::mounting, "mount", mount);
    if (variation_.position > 0)
      unit.position = states_.mounting_.moved(
          unit.position, {variation_.position * draws.normal(0), variation_.position * draws.normal(1)});
    if (variation_.tilt_deg > 0) {
      const Frame frame = Frame::about(unit.axis);
      constexpr std::uint32_t first = 1000;
      const double x = std::tan(radians(variation_.tilt_deg * draws.normal(first))),
                   y = std::tan(radians(variation_.tilt_deg * draws.normal(first + 1)));
      const Vec3 axis = unit.axis + frame.x * x + frame.y * y;
      unit.axis = normalized({rounded(axis.x, 1e9), rounded(axis.y, 1e9), rounded(axis.z, 1e9)});
    }
  }

  void vary(Fixture& fixture, double open_doors) const {
    expect_running(state_.cancel);
    std::visit(
        [&]<class T>(T& one) {
          if constexpr (std::is_base_of_v<Shelving, T>) {
            if (varies(Cause::stock)) vary_stock(one);
            if (varies(Cause::doors) && one.doors &&
                draws(Cause::doors, "doors", one.id).uniform(0) < open_doors)
              one.doors_open = true;
            one.variation = {};
            one.labels.reset();  // the state lists them
          }
        },
        fixture);
  }

  // The levels of rows have a Gaussian copula, so each is uniformly distributed.
  template <class T>
  void vary_stock(T& shelves) const {
    const Range range = shelves.variation.stocking.value_or(variation_.stocking);
    const Draws draws = this->draws(Cause::stock, "stocking", shelves.id);
    constexpr std::uint32_t number = 1'000'000'000;
    shelves.arrangement = 1 + to_index(draws.bits(0), number);
    shelves.row_stocking.clear();
    const auto level = [&](double share) { return rounded(range.at(share), 1e3); };
    if (variation_.correlation == 1 || range.low == range.high) {
      shelves.stocking = level(draws.uniform(1));
      return;
    }
    const double common = std::sqrt(variation_.correlation) * draws.normal(2),
                 own = std::sqrt(1 - variation_.correlation);
    std::uint32_t row = 3;
    const auto add_rows = [&](Face face, std::size_t count) {
      for (std::size_t k = 0; k < count; ++k) {
        const double z = common + own * draws.normal(row++);
        shelves.row_stocking[face].push_back(level(0.5 * std::erfc(-z / std::sqrt(2.0))));
      }
    };
    const GoodsRows rows = shelves.goods_rows();
    for (const Face face : rows.faces) add_rows(face, rows.levels);
  }

  // Boxes without a free place after many attempts are omitted: the area is full. If a thousand do not fit,
  // those after them have few attempts.
  void stand(const StandingBoxes& boxes) {
    const Scene& scene = states_.scene_;
    const Polygon& area = polygon_of(boxes.area, scene.room ? &*scene.room : nullptr);
    const bool leaves_zones = leaves_out_zones(boxes.area);
    const PlanBounds bounds = bounds_of(area);
    constexpr std::size_t edges_per_effort = 400;
    const std::size_t room_edges = scene.room ? scene.room->outline.size() : 0;
    const std::size_t effort = 1 + (area.size() + room_edges) / edges_per_effort;
    const Cause cause = boxes.is_person ? Cause::people : Cause::objects;
    const std::int64_t number = number_of(boxes, draws(cause, "number", boxes.id).uniform(0));
    const bool is_single = std::holds_alternative<Presence>(boxes.number);
    for (std::int64_t n = 1; n <= number; ++n) {
      expect_running(state_.cancel);
      const std::string id = is_single ? boxes.id : fmt::format("{} {}", boxes.id, n);
      const Draws draws = this->draws(cause, "place", id);
      constexpr std::size_t max_effort = 1'000'000;
      const std::uint32_t attempts = effort_ < max_effort ? 1000 : 10;
      for (std::uint32_t a = 0; a < attempts; ++a, effort_ += effort) {
        const auto within = [&](std::size_t axis) {
          return bounds.low[axis] + draws.uniform(4 * a + static_cast<std::uint32_t>(axis)) *
                                        (bounds.high[axis] - bounds.low[axis]);
        };
        const Vec2 middle{within(0), within(1)};
        if (!contains(area, middle) || (leaves_zones && scene.room->zone_over(middle) != nullptr)) continue;
        const double rotation_deg = rounded(360 * draws.uniform(4 * a + 2), 10);
        const Vec2 half = turned({boxes.size.x / 2, boxes.size.y / 2}, rotation_deg);
        const Vec2 at{rounded(middle[0] - half[0], 1e3), rounded(middle[1] - half[1], 1e3)};
        if (!taken_.take(plan_of(boxes, at, rotation_deg), boxes.size.z)) continue;
        add_box(boxes, id, {at[0], at[1], 0}, rotation_deg);
        break;
      }
    }
  }

  static Polygon plan_of(const StandingBoxes& boxes, const Vec2& at, double rotation_deg) {
    Polygon plan;
    for (const auto& [x, y] :
         {Vec2{0, 0}, {boxes.size.x, 0}, {boxes.size.x, boxes.size.y}, {0, boxes.size.y}}) {
      const Vec2 corner = turned({x, y}, rotation_deg);
      plan.push_back({at[0] + corner[0], at[1] + corner[1]});
    }
    return plan;
  }

  void add_box(const StandingBoxes& boxes, const std::string& id, const Vec3& at, double rotation_deg) {
    if (ids_.empty())
      for (const FixtureOutline& fixture : states_.scene_.fixtures) ids_.insert(fixture.id);
    Box box;
    box.id = id;
    while (!ids_.insert(box.id).second) box.id += "'";
    box.min = at;
    box.size = boxes.size;
    box.max = at + boxes.size;
    box.rotation_deg = rotation_deg;
    box.material = boxes.material;
    state_.fixtures.push_back({std::move(box), where_});
  }

  const StoreStates& states_;
  const Scene& devices_;
  const StoreVariation& variation_;
  const StateNumbers& numbers_;
  Store state_;
  std::string where_;       ///< for messages
  TakenFloor taken_;        ///< by people and objects
  std::size_t effort_ = 0;  ///< of attempts without a free place
  std::set<std::string> ids_;
};

void expect_variation(const Store& store) {
  if (!store.variation)
    throw InputError(store.file, "has no section 'variation', so it has only one state",
                     "add the section, even if it is empty");
}

void leave_out(Store& store, const std::vector<Cause>& causes) {
  if (causes.empty()) return;
  if (!store.variation)
    throw InputError(store.file, "has no section 'variation', so there is no change to leave out",
                     "add the section, or leave out nothing", Setting::without);
  store.variation->leave_out(causes);
}

StoreStates::StoreStates(const Store& store, const Scene& scene, std::uint64_t seed)
    : store_(store), scene_(scene), seed_(seed), floor_(scene), mounting_(scene) {
  expect_variation(store);
  for (const auto& [fixture, where] : store.fixtures) {
    const Shelving* shelves = shelving_of(fixture);
    open_doors_.push_back(shelves == nullptr ? 0 : share_open(*store.variation, *shelves));
  }
}

Store StoreStates::state(const StateNumbers& numbers, const Scene& devices) const {
  return Drawing(*this, numbers, devices).drawn();
}

std::vector<Cause> StoreStates::causes() const {
  const StoreVariation& variation = *store_.variation;
  const auto has_fixture = [&](const auto& test) { return any_shelving(store_.fixtures, test); };
  const auto has_boxes = [&](bool people) {
    return std::any_of(variation.boxes.begin(), variation.boxes.end(),
                       [&](const StandingBoxes& boxes) { return boxes.is_person == people; });
  };
  std::vector<Cause> causes;
  if (has_fixture([](const Shelving&) { return true; })) causes.push_back(Cause::stock);
  if (has_boxes(true)) causes.push_back(Cause::people);
  if (has_boxes(false)) causes.push_back(Cause::objects);
  if (has_fixture([](const Shelving& shelves) { return shelves.doors.has_value(); }))
    causes.push_back(Cause::doors);
  if (variation.position > 0 || variation.tilt_deg > 0 || variation.unit_power_db > 0)
    causes.push_back(Cause::mounting);
  if (variation.label_sensitivity_db > 0) causes.push_back(Cause::labels);
  std::erase_if(causes, [&](Cause cause) { return !variation.varies(cause); });
  return causes;
}

}  // namespace shelfbeam
