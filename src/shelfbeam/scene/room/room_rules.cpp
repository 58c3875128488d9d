#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/field_reader.hpp"
#include "shelfbeam/scene/plan_parts.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/room/plan_effort.hpp"
#include "shelfbeam/scene/room/plan_lines.hpp"
#include "shelfbeam/scene/room/room.hpp"

namespace shelfbeam {

namespace {

constexpr double negligible = 1e-6;  // m^2
constexpr double rule_slack = 1e-9;  // m

// A ceiling must be above the floor everywhere.
void expect_headroom(const JsonCursor& json, const CeilingHeight& height, const Polygon& polygon) {
  constexpr double least = 0.1, most = 1000;
  for (const Vec2& corner : polygon)
    if (const double z = height.at(corner); !(z >= least && z <= most))
      json.fail(fmt::format("is {} at {}", length_text(z, json.unit()), point_text(corner, json.unit())),
                fmt::format("a ceiling is {} to {} m above the floor", least, most));
}

// The distance from the outline to the farthest point of a polygon outside it. Corners of a part outside may
// all lie on the outline, therefore points between them count, too.
double distance_outside(const Polygon& polygon, const RoomShape& room) {
  double farthest = 0;
  const auto include = [&](const Vec2& p) {
    if (!contains(room.outline, p)) farthest = std::max(farthest, distance_to_border(room.outline, p));
  };
  for (const PlanPart& part : plan_parts(room, polygon)) {
    if (part.ceiling != nullptr) continue;
    for (std::size_t k = 0; k < part.points.size(); ++k) {
      const Vec2 &a = part.points[k], &b = part.points[(k + 1) % part.points.size()];
      include(a);
      include({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
    }
  }
  return farthest;
}

// A part beyond the outline is cut off. It may result from rounded corners.
void expect_within_outline(const JsonCursor& json, const Polygon& polygon, const RoomShape& room,
                           PlanEffort& effort) {
  constexpr double rounded = 0.01;
  RoomShape outer;
  outer.outline = room.outline;
  effort.divide(outer, polygon, json);
  if (const double far = distance_outside(polygon, outer); far > rounded)
    json.fail(fmt::format("extends {} outside the room", length_text(far, json.unit())),
              room.is_box ? "keep it within the walls" : "keep it within 'outline'");
}

// Building the room divides the plan where lines cross.
void expect_few_lines(const JsonCursor& json, const RoomShape& shape) {
  const PlanLines lines = PlanLines::of(shape);
  constexpr auto remedy = "use fewer zones, inner walls and openings, or fewer heights with a sloped ceiling";
  if (lines.count() > PlanLines::max_count)
    json.fail(fmt::format("has more than {} edges in its plan", grouped(PlanLines::max_count)), remedy);
  if (lines.crossings(PlanLines::max_crossings) > PlanLines::max_crossings)
    json.fail(fmt::format("has edges that meet in more than {} points of its plan",
                          grouped(PlanLines::max_crossings)),
              remedy);
}

// Whether an opening extends beyond the outline or into a hole. A wall may end obliquely at a wall of the
// room, so the middle of the wall decides, where panes are.
bool is_cut_off(const RoomShape& shape, InnerWall wall, const WallOpening& opening) {
  wall.thickness = 1e-3;
  const RoomShape walls = walls_of(shape);
  return leave_room(plan_parts(walls, wall.footprint(opening.at, opening.at + opening.width)));
}

// The rules that tie the parts of a room together. Each part is compared with those before it.
class RoomRules {
 public:
  RoomRules(FieldReader& reader, const RoomShape& shape) : reader_(reader), shape_(shape) {}

  void check() {
    const JsonCursor& json = reader_.json();
    const std::size_t failures = reader_.problems().failures();
    has_plan_ = reader_.rule({"size", "outline", "height"}, [&] {
      if (!shape_.is_box) expect_headroom(json["height"], shape_.height, shape_.outline);
      effort_.add_corners(shape_.outline, json);
    });
    has_outline_ = has_plan_;
    reader_.rule({"outline", "wall_materials"}, [&] { check_wall_numbers(json); });
    has_plan_ = has_plan_ && reader_.rule({"holes"}, [&] {
      if (const auto holes = json.find("holes")) check_holes(*holes);
    });
    const bool has_zones =
        each("zones", shape_.zones.size(), [&](const JsonCursor& at, std::size_t k) { check_zone(at, k); });
    has_plan_ = has_plan_ && has_zones;
    each("inner_walls", shape_.inner_walls.size(),
         [&](const JsonCursor& at, std::size_t k) { check_wall(at, k); });
    each("openings", shape_.openings.size(), [&](const JsonCursor& at, std::size_t k) { check_row(at, k); });
    if (has_plan_ && reader_.problems().failures() == failures)
      reader_.rule({}, [&] { expect_few_lines(json, shape_); });
  }

 private:
  // Returns whether all members of the list are right, apart from rules of their own parts.
  template <class Check>
  bool each(std::string_view key, std::size_t count, const Check& check) {
    bool are_right = !reader_.has_failed(key);
    ids_.clear();
    for (std::size_t k = 0; k < count; ++k)
      are_right &=
          reader_.rule({fmt::format("{}[{}]", key, k)}, [&] { check(reader_.json()[key].element(k), k); });
    return are_right;
  }

  void expect_new_id(const JsonCursor& json, const std::string& id) {
    reader_.rule({}, [&] {
      if (!ids_.insert(id).second)
        json.fail(fmt::format("is the duplicate id {}", in_quotes(id)), "make ids unique");
    });
  }

  void check_wall_numbers(const JsonCursor& json) {
    const auto others = json.find("wall_materials");
    if (!others) return;
    const std::size_t last = shape_.outline.size() - 1;
    for (const auto& [number, name] : others->members())
      if (!to_whole_number(number, last))
        reader_.rule({}, [&, &name = name] {
          name.fail("is not the number of a wall", fmt::format("the outline has the walls 0 to {}", last));
        });
  }

  void check_holes(const JsonCursor& json) {
    double free = std::abs(signed_area(shape_.outline));
    bool are_right = true;
    for (std::size_t k = 0; k < shape_.holes.size(); ++k)
      are_right &= reader_.rule({}, [&] { free -= area_of_hole(json.element(k), k); });
    if (!are_right) throw Consequence{};
    if (free <= negligible) json.fail("cover the whole room", "remove or correct one of them");
  }

  double area_of_hole(const JsonCursor& json, std::size_t k) {
    const Polygon& hole = shape_.holes[k];
    expect_within_outline(json, hole, shape_, effort_);
    for (std::size_t other = 0; other < k; ++other)
      if (effort_.shared_area(hole, shape_.holes[other], json) > negligible)
        json.fail(fmt::format("overlaps hole {}", other), "join the two, or move one");
    effort_.add_corners(hole, json);
    return effort_.shared_area(hole, shape_.outline, json);
  }

  void check_zone(const JsonCursor& json, std::size_t k) {
    const CeilingZone& zone = shape_.zones[k];
    expect_new_id(json["id"], zone.id);
    if (zone.id == whole_room || zone.id == room_without_zones)
      json["id"].fail("is the name of an area in every room", "use another name");
    if (!has_plan_) return;
    const JsonCursor polygon = json["polygon"];
    expect_within_outline(polygon, zone.polygon, shape_, effort_);
    for (const CeilingZone& other : std::span(shape_.zones).first(k))
      if (!other.polygon.empty() && effort_.shared_area(zone.polygon, other.polygon, polygon) > negligible)
        polygon.fail(fmt::format("overlaps zone {}", in_quotes(other.id)), "zones must not overlap");
    expect_headroom(json["height"], zone.height, zone.polygon);
    effort_.add_corners(zone.polygon, polygon);
  }

  void check_wall(const JsonCursor& json, std::size_t number) {
    const InnerWall& wall = shape_.inner_walls[number];
    expect_new_id(json["id"], wall.id);
    constexpr double shortest = 1e-3;
    if (wall.length() < shortest) json["to"].fail("is at 'from': the wall has no length", "move it");
    if (has_plan_) expect_part_inside(json, wall.footprint(0, wall.length()));
    for (std::size_t k = 0; k < wall.openings.size(); ++k)
      reader_.rule({}, [&] { check_opening(json["openings"].element(k), wall, k); });
  }

  // The part of a wall outside the room is cut off.
  void expect_part_inside(const JsonCursor& json, const Polygon& footprint) {
    double area = effort_.shared_area(footprint, shape_.outline, json);
    for (const Polygon& hole : shape_.holes) area -= effort_.shared_area(footprint, hole, json);
    if (!(area > negligible)) json.fail("is outside the room", "move it inside");
  }

  void check_opening(const JsonCursor& json, const InnerWall& wall, std::size_t k) {
    const WallOpening& opening = wall.openings[k];
    if (opening.top <= opening.bottom) json["top"].fail("is not above 'bottom'", "swap or correct them");
    const auto text = [&](double metres) { return length_text(metres, json.unit()); };
    if (opening.at + opening.width > wall.length() + rule_slack)
      json.fail(fmt::format("extends from {} to {}, but the wall is {} long", text(opening.at),
                            text(opening.at + opening.width), text(wall.length())),
                "keep the opening within its wall");
    if (wall.height && opening.top > *wall.height + rule_slack)
      json["top"].fail(fmt::format("is above the wall of {}", text(*wall.height)),
                       "lower it, or raise the wall");
    if (has_plan_) expect_within_room(json, wall, opening);
    for (const WallOpening& other : std::span(wall.openings).first(k))
      if (opening.at < other.at + other.width && other.at < opening.at + opening.width &&
          opening.bottom < other.top && other.bottom < opening.top)
        json.fail("overlaps another opening of the wall", "move one of the two");
  }

  void check_row(const JsonCursor& json, std::size_t number) {
    const OpeningRow& row = shape_.openings[number];
    if (row.first.top <= row.first.bottom) json["top"].fail("is not above 'bottom'", "swap or correct them");
    constexpr std::size_t most = 1000;
    openings_ += row.count;
    if (openings_ > most)
      json.fail(fmt::format("is one of more than {} openings", grouped(most)), "use fewer or larger ones");
    if (!has_outline_) return;
    if (json["wall"].is_string() && !shape_.is_box)
      json["wall"].fail("is the name of a wall of a box, but the room has an 'outline'", "use its number");
    if (row.wall >= shape_.outline.size())
      json["wall"].fail("is not the number of a wall",
                        fmt::format("the room has the walls 0 to {}", shape_.outline.size() - 1));
    const double length = shape_.wall(row.wall).length();
    const auto text = [&](double metres) { return length_text(metres, json.unit()); };
    const double end = row.first.at + row.length();
    if (end > length + rule_slack)
      json.fail(fmt::format("extends from {} to {}, but wall {} is {} long", text(row.first.at), text(end),
                            row.wall, text(length)),
                row.count > 1 ? "keep the openings within their wall" : "keep the opening within its wall");
    for (std::size_t k = 0; has_plan_ && k < row.count; ++k)
      expect_beside_room(json, row.wall, row.opening(k));
    for (std::size_t other = 0; other < number; ++other)
      if (overlap(row, shape_.openings[other]))
        json.fail(fmt::format("overlaps openings[{}]", other), "move one of the two");
  }

  static bool overlap(const OpeningRow& row, const OpeningRow& other) {
    if (row.wall != other.wall || row.first.bottom >= other.first.top || other.first.bottom >= row.first.top)
      return false;
    for (std::size_t k = 0; k < row.count; ++k)
      for (std::size_t n = 0; n < other.count; ++n) {
        const WallOpening one = row.opening(k), two = other.opening(n);
        if (one.at < two.at + two.width - rule_slack && two.at < one.at + one.width - rule_slack) return true;
      }
    return false;
  }

  // The ceiling over the opening counts, and no hole may be there.
  void expect_beside_room(const JsonCursor& json, std::size_t wall, const WallOpening& opening) {
    constexpr double depth = 1e-3;
    const Vec2 inward = shape_.wall(wall).inward;
    const auto [a, b] = shape_.along_wall(wall, opening.at, opening.at + opening.width);
    const auto inside = [&](const Vec2& p) {
      return Vec2{p[0] + depth * inward[0], p[1] + depth * inward[1]};
    };
    const Polygon strip{a, b, inside(b), inside(a)};
    effort_.divide(shape_, strip, json);
    const std::vector<PlanPart> parts = plan_parts(shape_, strip);
    const bool is_cut_off = std::any_of(parts.begin(), parts.end(), [&](const PlanPart& part) {
      return part.ceiling == nullptr &&
             std::any_of(part.points.begin(), part.points.end(), [&](const Vec2& p) {
               return contains(shape_.outline, p) && distance_to_border(shape_.outline, p) > depth / 2;
             });
    });
    if (is_cut_off) json.fail("is in a part of its wall that a hole cuts off", "move it");
    if (const double ceiling = lowest_ceiling(parts); opening.top > ceiling + rule_slack)
      json["top"].fail(fmt::format("is above the ceiling of {}", length_text(ceiling, json.unit())),
                       "lower it");
  }

  void expect_within_room(const JsonCursor& json, const InnerWall& wall, const WallOpening& opening) {
    const Polygon footprint = wall.footprint(opening.at, opening.at + opening.width);
    effort_.divide(shape_, footprint, json);
    if (is_cut_off(shape_, wall, opening))
      json.fail("is in a part of its wall that is outside the room and cut off", "keep it within the room");
    const double ceiling = lowest_ceiling(plan_parts(shape_, footprint));
    if (opening.top > ceiling + rule_slack)
      json["top"].fail(fmt::format("is above the ceiling of {}", length_text(ceiling, json.unit())),
                       "lower it");
  }

  FieldReader& reader_;
  const RoomShape& shape_;
  bool has_plan_ = true;  // the outline, holes and zones so far are right
  bool has_outline_ = true;
  std::size_t openings_ = 0;   // in outer walls, so far
  std::set<std::string> ids_;  // of the list so far
  PlanEffort effort_;
};

}  // namespace

std::optional<Room> read_room(const JsonCursor& json, const StoreNames& names, Problems& problems) {
  Room room;
  if (!read_object(
          json, names, problems, [&](Fields& f) { room.fields(f); },
          [&](FieldReader& reader) { RoomRules(reader, room.shape).check(); }))
    return std::nullopt;
  return room;
}

}  // namespace shelfbeam
