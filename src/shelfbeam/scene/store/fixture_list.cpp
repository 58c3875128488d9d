#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/fixture/edge_place.hpp"
#include "shelfbeam/scene/fixture/fixture_builder.hpp"
#include "shelfbeam/scene/fixture/turn.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/scene_memory.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view number_place = "{n}";  // in ids of copies

// A straight line in plan to place a fixture against, with the direction away from it.
struct FootingEdge {
  Vec2 from{}, to{};
  Vec2 outward{};

  double length() const { return std::hypot(to[0] - from[0], to[1] - from[1]); }
  Vec2 direction() const { return {(to[0] - from[0]) / length(), (to[1] - from[1]) / length()}; }
};

FootingEdge side_of(const Footing& footing, Face face) {
  const double length = footing.length, depth = footing.depth;
  const auto point = [&](double along, double across) -> Vec2 {
    const auto [x, y] = turned({along, across}, footing.rotation_deg);
    return {footing.at[0] + x, footing.at[1] + y};
  };
  const auto edge = [&](const Vec2& from, const Vec2& to, double along, double across) {
    const Vec2 origin = point(0, 0), tip = point(along, across);
    return FootingEdge{from, to, {tip[0] - origin[0], tip[1] - origin[1]}};
  };
  switch (face) {
    case Face::front:
      return edge(point(length, 0), point(0, 0), 0, -1);
    case Face::back:
      return edge(point(0, depth), point(length, depth), 0, 1);
    case Face::left:
      return edge(point(0, 0), point(0, depth), -1, 0);
    case Face::right:
      return edge(point(length, depth), point(length, 0), 1, 0);
  }
  return {};
}

// The direction in which a number as 'step' moves copies; nothing for fixtures without a length.
std::optional<Vec2> length_direction(const Fixture& fixture) {
  if (const auto footing = footing_of(fixture)) return turned({1, 0}, footing->rotation_deg);
  if (const auto frame = frame_of(fixture)) return turned({1, 0}, frame->rotation_deg);
  return {};
}

Vec3 in_store(const Vec3& local, double rotation_deg) {
  const auto [x, y] = turned({local.x, local.y}, rotation_deg);
  return {x, y, local.z};
}

class FixtureList {
 public:
  FixtureList(const StoreNames& names, const StoreFolder& folder, Presets& presets, Store& store,
              Problems& problems)
      : names_(names),
        folder_(folder),
        presets_(presets),
        store_(store),
        problems_(problems),
        memory_(folder.memory()) {}

  void read(const JsonCursor& given) {
    expect_running(store_.cancel);
    const std::size_t failures = problems_.failures();
    problems_.collect([&] { read_whole(presets_.complete(given)); });
    if (problems_.failures() == failures) return;
    problems_.mark("some fixture");
    const auto id = given.is_object() ? given.find("id") : std::nullopt;
    const bool is_one = id && id->is_string() && id->text().find(number_place) == std::string::npos;
    problems_.mark(is_one ? "fixture " + id->text() : "fixture");
  }

 private:
  void read_whole(JsonCursor json) {
    const std::size_t failures = problems_.failures();
    const std::string type = json["type"].text();
    const auto repeat = json.find("repeat"), labels = json.find("labels"), against = json.find("against");
    const bool has_places = labels && labels->is_array();
    const Fixture* empty = fixture_type(type);
    problems_.collect([&] {
      if (labels && !has_places && empty != nullptr && !label_edges(*empty))
        labels->fail("is not a list", fmt::format("list the labels of a {} with their positions", type));
    });
    Json value = json.value();
    value.erase("repeat");
    if (has_places || failures != problems_.failures()) value.erase("labels");
    std::optional<FootingEdge> edge;
    if (against) {
      if (!problems_.collect([&] { edge = place(json, *against, value); })) {
        value["at"] = json.find("size") ? Json{0, 0, 0} : Json{0, 0};
        value.erase("rotation_deg");
      }
      value.erase("against");
    }
    if (repeat || has_places || against || failures != problems_.failures())
      json = json.replaced(std::move(value));
    const Fixture fixture = read_fixture(json, names_, folder_, problems_);
    std::optional<Repeat> copies;
    if (repeat) {
      const bool is_by_wall = against && against->find("wall");
      problems_.collect([&] {
        const auto forwards = is_by_wall && edge ? edge->direction() : length_direction(fixture);
        copies = read_repeat(*repeat, forwards, json["type"].text());
      });
    }
    if (failures != problems_.failures()) {
      if (const auto side = footing_of(fixture); side && side->length > 0 && side->depth > 0)
        store_.unfinished.push_back({fixture, json.where()});
      if (has_places)
        for (const JsonCursor& label : labels->elements()) read_placed_label(label);
      return;
    }
    expect_few_labels(labels, fixture, copies ? copies->count() : 1);
    const std::size_t first = store_.fixtures.size();
    folder_.expect_few_fixtures(first + static_cast<std::size_t>(copies ? copies->count() : 1), json);
    if (copies) {
      add_copies(json, fixture, *copies, *repeat);
    } else {
      if (id_of(fixture).find(number_place) != std::string::npos)
        json["id"].fail("has the number {n} of a copy, but there is no 'repeat'",
                        "add 'repeat', or remove {n}");
      add(fixture, json.where(), json.where());
    }
    if (has_places)
      for (std::size_t k = first; k < store_.fixtures.size(); ++k)
        add_labels(*labels, store_.fixtures[k].value, copies.has_value());
  }

  struct Row {
    std::int64_t count = 1;
    Vec2 step{};  ///< m

    Vec3 shift(std::int64_t k) const { return Vec3{step[0], step[1], 0} * static_cast<double>(k); }
  };
  // Copies are counted before they are made, because each has its own mesh.
  void add(Fixture fixture, const std::string& where, const std::string& entry) {
    memory_.add(static_cast<double>(scene_bytes(fixture) + 4 * id_of(fixture).size()), entry);
    index_.emplace(id_of(fixture), store_.fixtures.size());
    store_.fixtures.push_back({std::move(fixture), where});
  }

  struct Repeat {
    Row row, rows;
    std::int64_t first = 1;
    bool turns = false;

    std::int64_t count() const { return row.count * rows.count; }
  };

  // Labels are counted before they are made. `labels`: the key, a list or the labels on edges.
  void expect_few_labels(const std::optional<JsonCursor>& labels, const Fixture& fixture,
                         std::int64_t copies) {
    if (!labels) return;
    constexpr double most = 1e6;
    const bool is_list = labels->is_array();
    const double each = is_list ? static_cast<double>(labels->size()) : label_count(fixture);
    const double all = each * static_cast<double>(copies);
    if (all > most)
      labels->fail(fmt::format("produces {:.0f} labels{}", all,
                               copies > 1 ? fmt::format(", {:.0f} for each of {} copies", each, copies) : ""),
                   fmt::format("at most {:.0f} are allowed for a fixture and its copies", most));
    if (is_list) memory_.add(all * device_bytes_of(id_of(fixture)), labels->where());
  }

  // The labels on edges.
  static double label_count(const Fixture& fixture) {
    const Shelving* shelves = shelving_of(fixture);
    if (shelves == nullptr || !shelves->labels) return 0;
    std::size_t count = 0;
    for (const Face face : shelves->labels->faces)
      count += shelves->labels->along(edge_length(shelves->footing(), face)).size();
    return static_cast<double>(count * label_edges(fixture)->heights.size());
  }

  // "store.json: fixtures[2] (copy 'A3')": all copies have one place in the file.
  static std::string copy_of(const JsonCursor& json, const std::string& id) {
    constexpr std::size_t longest = 60;
    return fmt::format("{} (copy {})", json.where(), in_quotes(shortened(id, longest)));
  }

  // A number moves copies `forwards`.
  static Repeat read_repeat(const JsonCursor& json, const std::optional<Vec2>& forwards,
                            const std::string& type) {
    json.expect_keys({"count", "step", "first", "count2", "step2", "mirror"});
    constexpr std::int64_t max_count = 10'000;
    const auto read_step = [&](const JsonCursor& step) -> Vec2 {
      if (step.is_array()) return read_plan_point(step);
      const double distance = read_coordinate(step);
      if (!forwards)
        step.fail(fmt::format("is one number, a step along the length, which a {} does not have", type),
                  "give [x, y]");
      return {distance * (*forwards)[0], distance * (*forwards)[1]};
    };
    Repeat repeat;
    repeat.row = {json["count"].integer(1, max_count), read_step(json["step"])};
    if (const auto first = json.find("first")) repeat.first = first->integer(0, max_count);
    if (const auto count = json.find("count2"))
      repeat.rows = {count->integer(1, max_count), read_step(json["step2"])};
    else if (const auto step = json.find("step2"))
      step->fail("has no effect without 'count2'", "add 'count2', or remove it");
    if (const auto mirror = json.find("mirror")) repeat.turns = mirror->boolean();
    if (repeat.count() > max_count)
      json.fail(fmt::format("produces {} fixtures", repeat.count()),
                fmt::format("at most {} are allowed", max_count));
    return repeat;
  }

  void add_copies(const JsonCursor& json, const Fixture& fixture, const Repeat& repeat,
                  const JsonCursor& given) {
    constexpr double farthest = 1e4;  // m, as for coordinates
    const std::string& pattern = id_of(fixture);
    if (repeat.count() > 1 && pattern.find(number_place) == std::string::npos)
      json["id"].fail(fmt::format("is {} for all copies", in_quotes(pattern)),
                      "write {n} for the number of the copy: \"A{n}\"");
    for (std::int64_t j = 0; j < repeat.rows.count; ++j)
      for (std::int64_t k = 0; k < repeat.row.count; ++k) {
        expect_running(store_.cancel);
        Fixture copy = fixture;
        const std::int64_t number = repeat.first + j * repeat.row.count + k;
        const Vec3 by = repeat.row.shift(k) + repeat.rows.shift(j);
        if (length(by) > farthest)
          given.fail(fmt::format("puts a copy {:.6g} m from the first", length(by)),
                     "reduce 'step' or 'count'");
        std::visit(
            [&](auto& one) {
              one.id = with_number(pattern, number);
              if (repeat.turns && k % 2 == 1) one.turn_about_middle();
              one.move(by);
            },
            copy);
        const std::string where = copy_of(json, id_of(copy));
        add(std::move(copy), where, json.where());
      }
  }

  static std::string with_number(std::string_view pattern, std::int64_t number) {
    const std::string digits = fmt::format("{}", number);
    std::string id;
    for (std::size_t at; (at = pattern.find(number_place)) != std::string_view::npos;) {
      id.append(pattern.substr(0, at)).append(digits);
      pattern.remove_prefix(at + number_place.size());
    }
    return id.append(pattern);
  }

  Label read_placed_label(const JsonCursor& json) {
    Label label;
    read_object(json, names_, problems_, [&](Fields& f) { describe(label, f); });
    return label;
  }

  // Labels at given places of a fixture, which move and turn with it.
  void add_labels(const JsonCursor& labels, const Fixture& fixture, bool is_copy) {
    const auto frame = frame_of(fixture);
    if (!frame)
      labels.fail(
          "lists labels of a fixture that is neither a box with 'at' nor a mesh, or of a mesh in map "
          "coordinates",
          "list them in 'labels' of the store, with their positions in the store");
    for (const JsonCursor& json : labels.elements()) {
      expect_running(store_.cancel);
      Label label = read_placed_label(json);
      label.id = fmt::format("{}-{}", id_of(fixture), label.id);
      label.position = frame->at + in_store(label.position, frame->rotation_deg);
      label.normal = in_store(label.normal, frame->rotation_deg);
      label.place.fixture = id_of(fixture);
      store_.labels.push_back({std::move(label), is_copy ? copy_of(json, id_of(fixture)) : json.where()});
    }
  }

  // Sets "at" and "rotation_deg" of a fixture whose back stands against a wall or a side of another fixture.
  // Returns the wall or the side.
  FootingEdge place(const JsonCursor& json, const JsonCursor& against, Json& value) const {
    for (const char* key : {"at", "rotation_deg"})
      if (const auto found = json.find(key))
        found->fail("has no effect beside 'against'", "remove one of the two");
    const bool by_wall = against.find("wall").has_value();
    if (by_wall == against.find("fixture").has_value())
      against.fail("must have one of 'wall' and 'fixture'", "keep one of them");
    against.expect_keys(by_wall ? std::initializer_list<std::string_view>{"wall", "from", "gap"}
                                : std::initializer_list<std::string_view>{"fixture", "side", "shift", "gap"});
    const std::string type = json["type"].text();
    const Fixture* empty = fixture_type(type);
    if (!json.find("size") && (empty == nullptr || shelving_of(*empty) == nullptr))
      against.fail(
          fmt::format("does not apply to a {}{}", type, json.find("min") ? " with 'min' and 'max'" : ""),
          fmt::format("use it for {} with 'size'", types_with_sides));
    const FootingEdge edge = by_wall ? wall_edge(against["wall"]) : side_of(against);
    const auto gap_found = against.find("gap");
    const double gap = gap_found ? gap_found->metres(0, 1e3) : 0;
    const double length = size_of(json, 0), depth = size_of(json, 1);
    double from = (edge.length() - length) / 2;
    if (by_wall)
      from = read_from(against["from"], edge, length);
    else if (const auto shift = against.find("shift"))
      from -= read_coordinate(*shift);
    // Its length runs to the right of a person who faces it.
    const auto [x, y] = edge.direction();
    const bool runs_along = y * edge.outward[0] - x * edge.outward[1] > 0;
    const double start = runs_along ? from : from + length;
    const Vec2 corner{edge.from[0] + start * x + (gap + depth) * edge.outward[0],
                      edge.from[1] + start * y + (gap + depth) * edge.outward[1]};
    const double factor = to_metres(1, json.unit());
    value["at"] = {corner[0] / factor, corner[1] / factor};
    if (json.find("size")) value["at"].push_back(0);
    value["rotation_deg"] = rounded_degrees(std::atan2(edge.outward[0], -edge.outward[1]));
    return edge;
  }

  // The distance from the first corner of a wall to a fixture of this length.
  static double read_from(const JsonCursor& json, const FootingEdge& wall, double length) {
    constexpr double rounding = 1e-6;  // m
    const double from = json.metres(0, 1e3), end = from + length;
    if (end > wall.length() + rounding)
      json.fail(
          fmt::format("puts the end of the fixture {} from the first corner of the wall, which is {} long",
                      length_text(end, json.unit()), length_text(wall.length(), json.unit())),
          "reduce it, or use another wall");
    return from;
  }

  static double rounded_degrees(double angle) {
    const double degrees = angle * 180 / pi, quarter = std::round(degrees / 90) * 90;
    return std::abs(degrees - quarter) < 1e-9 ? quarter : degrees;
  }

  static double size_of(const JsonCursor& json, std::size_t axis) {
    if (const auto size = json.find("size")) {
      size->numbers(3);
      return read_length(size->element(axis));
    }
    return read_length(json[axis == 0 ? "length" : "depth"]);
  }

  FootingEdge wall_edge(const JsonCursor& json) const {
    problems_.expect_complete("room");
    if (!store_.room) json.fail("names a wall, but the store has no room", "add a room");
    const RoomShape& shape = store_.room->shape;
    const auto last = static_cast<std::int64_t>(shape.outline.size()) - 1;
    const auto [from, to, inward] = shape.wall(static_cast<std::size_t>(json.integer(0, last)));
    return {from, to, inward};
  }

  FootingEdge side_of(const JsonCursor& against) const {
    const JsonCursor name = against["fixture"];
    const std::string id = name.text();
    const auto found = index_.find(id);
    if (found == index_.end()) expect_fixtures(problems_, id);
    if (found == index_.end())
      name.fail(fmt::format("names the fixture {}, which is not listed before", in_quotes(id)),
                "list it before, or correct the id");
    const auto footing = footing_of(store_.fixtures[found->second].value);
    if (!footing) name.fail("names a fixture without sides", fmt::format("use {}", types_with_sides));
    return shelfbeam::side_of(*footing, against["side"].choice<Face>());
  }

  const StoreNames& names_;
  const StoreFolder& folder_;
  Presets& presets_;
  Store& store_;
  Problems& problems_;
  SceneMemory memory_;
  std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace

void read_fixtures(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                   Presets& presets, Store& store, Problems& problems) {
  FixtureList list(names, folder, presets, store, problems);
  const std::vector<JsonCursor> fixtures = section.elements();
  for (const JsonCursor& fixture : fixtures) presets.take(fixture);  // all, before any takes its time
  for (const JsonCursor& fixture : fixtures) list.read(fixture);
}

}  // namespace shelfbeam
