#include <algorithm>
#include <cmath>
#include <new>
#include <set>
#include <string_view>
#include <unordered_set>

#include <fmt/format.h>

#include "shelfbeam/base/changed_ids.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/scene/build/decisive_values.hpp"
#include "shelfbeam/scene/build/draft.hpp"
#include "shelfbeam/scene/build/given_units.hpp"
#include "shelfbeam/scene/build/label_places.hpp"
#include "shelfbeam/scene/build/misplaced.hpp"
#include "shelfbeam/scene/build/mount_points.hpp"
#include "shelfbeam/scene/build/scene_size.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/fixture/fixture_builder.hpp"
#include "shelfbeam/scene/store/scene_memory.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"
#include "shelfbeam/scene/warning_list.hpp"

namespace shelfbeam {

namespace {

double scene_bytes(const TransceiverGrid& grid) {
  return device_bytes * ((grid.max[0] - grid.min[0]) / grid.spacing + 2) *
         ((grid.max[1] - grid.min[1]) / grid.spacing + 2);
}

// The areas as flat boxes at height 0; areas include their edges.
BoxIndex in_plan(const std::vector<Listed<KeepOut>>& areas) {
  return BoxIndex::over(areas, [](const auto& listed) {
    constexpr double slack = 1e-9;
    const KeepOut& area = listed.value;
    return Bounds{{area.min[0], area.min[1], 0}, {area.max[0], area.max[1], 0}}.wider_by(slack);
  });
}

class SceneMaker {
 public:
  /// With `problems`, a draft (draft.hpp).
  explicit SceneMaker(const Store& store, SceneDetail detail = SceneDetail::surfaces,
                      Problems* problems = nullptr)
      : store_(store),
        problems_(problems),
        detail_(detail),
        keep_out_(in_plan(store.keep_out)),
        memory_(store.memory) {}

  Scene make() {
    try {
      add_everything();
      if (problems_ == nullptr) check();
      return std::move(scene_);
    } catch (const std::bad_alloc&) {
      throw MemoryError(
          store_.file,
          fmt::format("requires about {:.3g} GB of memory, more than is available", 1e-9 * memory_.bytes()),
          "use wider spacings or simpler meshes, or a machine with more memory");
    }
  }

  DeviceSources sources() { return std::move(sources_); }

 private:
  void add_everything() {
    scene_.name = store_.name;
    scene_.language = store_.language;
    scene_.wavelength_nm = store_.wavelength_nm;
    // Without any price, a plan has none.
    if (std::ranges::any_of(store_.transceiver_types, &TransceiverType::has_cost))
      scene_.currency = store_.currency;
    scene_.materials = store_.materials;
    scene_.areas.assign(scene_.materials.size(), 0);
    scene_.label_types = store_.label_types;
    scene_.transceiver_types = store_.transceiver_types;
    for (const Finding& warning : store_.warnings) warnings_.add(warning);
    expect_memory();
    add_room();
    add_fixtures();
    add_inner_walls();
    expect_memory_of_mounts();
    attempt([&] {
      if (is_read_ && !scene_.room && scene_.fixtures.empty())
        fail("has neither a room nor fixtures", "add a room");
    });
    find_bounds();
    add_labels();
    attempt([&] { add_transceivers(); });
    attempt([&] { mark_given_units(store_, kept_out_ids_, scene_, sources_); });
    scene_.source = store_.source;
    scene_.values = decisive_values(store_, scene_);
  }

  void check() {
    warn_of_bright_materials();
    warn_of_misplaced(scene_, sources_, warnings_, store_.cancel);
    scene_.warnings = warnings_.findings();
    scene_.ignored_warnings = warnings_.ignored();
    scene_.store_hash = hash_of_resolved(resolved_store_json(store_, scene_));
  }

  // Throws the InputError of a step or, for a draft, keeps it. Returns whether the step succeeded.
  template <class Step>
  bool attempt(const Step& step) {
    if (problems_ != nullptr) return problems_->collect(step);
    step();
    return true;
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& suggestion) const {
    throw InputError(store_.file, problem, suggestion);
  }

  // Checks the memory before anything is allocated.
  void expect_memory() {
    for (const auto& [fixture, where] : store_.fixtures)
      memory_.add(static_cast<double>(scene_bytes(fixture)), where);
    for (const auto& [grid, where] : store_.grids) expect_memory(scene_bytes(grid), where);
    for (const auto& [label, where] : store_.labels) memory_.add(device_bytes_of(label.id), where);
    for (const auto& [plane, where] : store_.measuring_planes) {
      const auto [columns, rows] = plane.cells();
      memory_.add(static_cast<double>(columns * rows) * device_bytes_of(plane.id), where);
    }
    for (const auto& [unit, where] : store_.transceivers) memory_.add(device_bytes_of(unit.id), where);
  }

  // Of candidates, which a draft lacks if they exceed the limit.
  void expect_memory(double bytes, const std::string& where) {
    if (problems_ == nullptr) return memory_.add(bytes, where);
    const SceneMemory before = memory_;
    try {
      memory_.add(bytes, where);
    } catch (const InputError& error) {
      problems_->keep(error);
      memory_ = before;
      crowded_.insert(where);
    }
  }

  // The faces of fixtures, on which candidates are mounted, are known only after these are built.
  void expect_memory_of_mounts() {
    for (const MountCount& mount : candidate_counts(store_, scene_)) {
      constexpr std::size_t max_candidates = 1'000'000;
      const bool is_right = attempt([&] {
        if (!mount.fault.empty())
          throw InputError(mount.where + ".face", mount.fault, "name another face, or remove the key");
        if (mount.candidates > max_candidates)
          throw InputError(mount.where + ".spacing", fmt::format("produces {} candidates", mount.candidates),
                           "use a wider spacing");
      });
      if (is_right)
        expect_memory(mount.bytes, mount.where);
      else
        crowded_.insert(mount.where);
    }
  }

  void add_room() {
    if (!store_.room) return;
    attempt([&] { expect_outer_panes(*store_.room, scene_.materials, store_.file); });
    scene_.room = store_.room->shape;
    wall_surfaces_ = add_shell(*store_.room, scene_.mesh);
    for (std::size_t t = 0; t < scene_.mesh.triangles.size(); ++t)
      scene_.areas[scene_.mesh.materials[t].value] += scene_.mesh.area_of(t);
  }

  void add_fixtures() {
    for (const auto& [fixture, where] : store_.fixtures) add_one_fixture(fixture, where, true);
    for (const auto& [fixture, where] : store_.unfinished) add_one_fixture(fixture, where, false);
  }

  // An unfinished fixture has only its outline: its problems are known already.
  void add_one_fixture(const Fixture& fixture, const std::string& where, bool is_finished) {
    expect_running(store_.cancel);
    const SceneSize before(scene_);
    if (is_finished) is_finished = attempt([&] { expect_new_fixture(id_of(fixture), where); });
    if (attempt([&] {
          add_fixture(scene_, fixture, where, warnings_, detail_);
          if (detail_ == SceneDetail::surfaces && extends_outside_room(scene_, before.vertices, before.parts))
            warnings_.add(FindingCode::fixture_outside_room, where,
                          "fixture {} extends outside the room; move it, or correct {}",
                          in_quotes(id_of(fixture)), sized_by(fixture));
          sources_.fixtures.push_back(where);
        })) {
      if (detail_ == SceneDetail::outlines) {
        include_vertices(before.vertices);
        before.restore_surfaces(scene_);
      }
      if (!is_finished) scene_.labels.resize(before.labels);
      sources_.labels.resize(scene_.labels.size(), where);
    } else {
      before.restore(scene_);
    }
  }

  void expect_new_fixture(const std::string& id, const std::string& where) {
    if (!fixture_ids_.insert(id).second)
      throw InputError(where, fmt::format("has the duplicate fixture id {}", in_quotes(id)),
                       "make ids unique");
  }

  void add_inner_walls() {
    if (!store_.room) return;
    for (std::size_t w = 0; w < store_.room->inner_walls.size(); ++w) {
      expect_running(store_.cancel);
      const std::string where = fmt::format("{}: room.inner_walls[{}]", store_.file, w);
      attempt([&] { expect_new_fixture(store_.room->shape.inner_walls[w].id, where); });
      const auto& panes = store_.room->inner_walls[w].panes;
      attempt([&] {
        for (std::size_t o = 0; o < panes.size(); ++o)
          if (panes[o])
            expect_pane(scene_.materials[panes[o]->value], fmt::format("{}.openings[{}].pane", where, o));
      });
      sources_.fixtures.push_back(where);
      add_wall_parts(*store_.room, w, wall_surfaces_[w], scene_);
    }
  }

  // Of the vertices from this one on.
  void include_vertices(std::size_t first) {
    for (std::size_t v = first; v < scene_.mesh.vertices.size(); ++v)
      bounds_.include(scene_.mesh.vertices[v]);
  }

  void find_bounds() {
    include_vertices(0);
    scene_.lower = bounds_.low;
    scene_.upper = bounds_.high;
  }

  // Smooth mirrors and glass are exempt, because chains over them end at random (follow_chain).
  void warn_of_bright_materials() {
    constexpr double usual = 0.97;
    const std::vector<bool> used = scene_.used_materials();
    for (std::size_t k = 0; k < used.size(); ++k) {
      if (!used[k]) continue;
      const NamedMaterial& named = scene_.materials[k];
      const auto given = given_reflectance(named.material);
      const bool is_rough_metal =
          std::holds_alternative<Conductor>(named.material) && !has_only_specular(named.material);
      const double reflectance = given            ? *given
                                 : is_rough_metal ? albedo(named.material, normalized(Vec3{1, 0, 1}))
                                                  : 0;
      if (reflectance <= usual) continue;
      warnings_.add(FindingCode::material_bright,
                    fmt::format("{}: materials.{}{}", store_.file, shortened(named.name, 60),
                                given ? ".reflectance" : ""),
                    "material '{}' reflects {:.3g} of the light, so paths between "
                    "such surfaces end late: the simulation is slow and its standard errors are less "
                    "reliable; white paint reflects 0.8 to 0.9, rough metal 0.6 to 0.9",
                    shortened(named.name, 60), reflectance);
    }
  }

  // `list`: the listed devices of the same kind, from which a remedy can be concluded.
  template <class List>
  void expect_in_room(const std::string& id, const Vec3& p, const std::string& where, const char* what,
                      const List& list) const {
    if (const std::string side = beyond_room(scene_, p); !side.empty()) {
      std::vector<Vec3> listed;
      listed.reserve(list.size());
      for (const auto& item : list) listed.push_back(item.value.position);
      const Vec3 size = scene_.room->upper();
      const std::string extent =
          scene_.room->is_box ? fmt::format(" of {:.6g} x {:.6g} x {:.6g} m", size.x, size.y, size.z) : "";
      throw InputError(where,
                       fmt::format("{} {} at ({:.6g}, {:.6g}, {:.6g}) is outside the room{}: {}", what,
                                   in_quotes(id), p.x, p.y, p.z, extent, side),
                       remedy_outside(*scene_.room, listed));
    }
  }

  void add_labels() {
    if (problems_ != nullptr) earlier_failures_ = problems_->failures();
    for (const auto& [label, where] : store_.labels) {
      scene_.labels.push_back(label);
      sources_.labels.push_back(where);
    }
    for (const auto& [plane, where] : store_.measuring_planes)
      plane.each_label([&, &source = where](Label label) {
        scene_.labels.push_back(std::move(label));
        sources_.labels.push_back(source);
      });
    find_label_places(store_, scene_);
    attempt([&] {
      if (is_read_ && scene_.labels.empty())
        fail("has no labels", "add 'labels' to the store or to a fixture");
    });
    std::unordered_map<std::string_view, std::size_t> seen;
    seen.reserve(scene_.labels.size());
    for (std::size_t i = 0; i < scene_.labels.size(); ++i) {
      expect_running(store_.cancel);
      if (!has_too_many_problems()) attempt([&] { expect_new_label(i, seen); });
    }
  }

  void expect_new_label(std::size_t i, std::unordered_map<std::string_view, std::size_t>& seen) const {
    const Label& label = scene_.labels[i];
    if (label.id.empty()) throw InputError(sources_.labels[i], "has a label without an id", "give it an id");
    const auto [first, is_new] = seen.emplace(label.id, i);
    if (!is_new)
      throw InputError(sources_.labels[i],
                       fmt::format("has the duplicate label id {}, first used in {}", in_quotes(label.id),
                                   sources_.labels[first->second]),
                       id_remedy(label.id, "make ids unique"));
    expect_in_room(label.id, label.position, sources_.labels[i], "label", store_.labels);
  }

  // With devices: each costs a look at all listed ones (remedy_outside). The rest is not checked.
  bool has_too_many_problems() const {
    constexpr std::size_t many = 100;
    return problems_ != nullptr && problems_->failures() > earlier_failures_ + many;
  }

  bool is_kept_out(const Vec3& p) const {
    const Vec3 q{p.x, p.y, 0};
    return keep_out_.any({q, q}, [&](std::uint32_t k) { return store_.keep_out[k].value.contains(p); });
  }

  void add_transceiver(const Transceiver& unit, const std::string& where) {
    expect_running(store_.cancel);
    const bool is_kept_out = this->is_kept_out(unit.position);
    if (!has_too_many_problems()) attempt([&] { expect_new_transceiver(unit, is_kept_out, where); });
    if (is_kept_out) {
      kept_out_ids_.insert(unit.id);
      return;
    }
    scene_.transceivers.push_back(unit);
    sources_.transceivers.push_back(where);
  }

  void expect_new_transceiver(const Transceiver& unit, bool is_kept_out, const std::string& where) {
    if (unit.id.empty()) throw InputError(where, "has a transceiver without an id", "give it an id");
    if (is_kept_out) return;
    expect_in_room(unit.id, unit.position, where, "transceiver", store_.transceivers);
    if (!unit_ids_.insert(unit.id).second)
      throw InputError(where, fmt::format("has the duplicate transceiver id {}", in_quotes(unit.id)),
                       id_remedy(unit.id, "make ids unique"));
  }

  void add_transceivers() {
    const std::vector<EmptyMount> empty = generate_candidates(
        store_, scene_, crowded_,
        [&](const Transceiver& unit, const std::string& where) { add_transceiver(unit, where); });
    for (const auto& [where, problem] : empty)
      warnings_.add(FindingCode::mount_empty, where, "{}; {}", problem, EmptyMount::remedy);
    for (const auto& [unit, where] : store_.transceivers) add_transceiver(unit, where);
    if (!is_read_ || !scene_.transceivers.empty()) return;
    if (!empty.empty()) throw InputError(empty.front().where, empty.front().problem, EmptyMount::remedy);
    fail("has no candidate transceivers", "add 'grids', 'areas' or a 'list', or shrink 'keep_out'");
  }

  const Store& store_;
  Problems* const problems_;                                                 // of a draft
  const bool is_read_ = problems_ == nullptr || problems_->failures() == 0;  // without problems
  const SceneDetail detail_;
  const BoxIndex keep_out_;
  Scene scene_;
  DeviceSources sources_;
  WarningList warnings_{store_.file, store_.ignored};
  SceneMemory memory_;
  std::unordered_set<std::string> unit_ids_;
  std::set<std::string> kept_out_ids_, fixture_ids_;
  std::set<std::string> crowded_;             ///< locations of grids and mounts that a draft lacks
  std::size_t earlier_failures_ = 0;          ///< of a draft, before those of devices
  std::vector<TriangleRange> wall_surfaces_;  ///< by inner wall
  Bounds bounds_;
};

}  // namespace

Scene make_scene(const Store& store, DeviceSources* sources) {
  SceneMaker maker(store);
  Scene scene = maker.make();
  if (sources != nullptr) *sources = maker.sources();
  return scene;
}

Draft read_draft(const JsonCursor& document, const std::filesystem::path& folder, SceneDetail detail,
                 const StoreLimits& limits) {
  Problems problems(document.file());
  Draft draft;
  problems.collect([&] { draft.store = parse_store(document, folder, limits, &problems); });
  SceneMaker maker(draft.store, detail, &problems);
  problems.collect([&] { draft.scene = maker.make(); });
  draft.sources = maker.sources();
  draft.problems = problems.all();
  return draft;
}

}  // namespace shelfbeam
