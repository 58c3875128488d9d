#include "jobs/preview/light_job.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/plan/preview/what_if.hpp"
#include "shelfbeam/plan/store/given_units.hpp"
#include "shelfbeam/scene/build/draft.hpp"
#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/transport/operator/light_operator.hpp"
#include "shelfbeam/transport/operator/unit_refinement.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

#include "jobs/preview/light_frame.hpp"
#include "jobs/preview/preview_job.hpp"

namespace shelfbeam::jobs {

namespace {

using Json = nlohmann::ordered_json;

constexpr double finest = 0.005;  // of the requirement: closer labels stay undecided
// Of Student's distribution with min_batches / 2 - 1 = 7 degrees of freedom, at 97.5 %, and of the normal
// one.
constexpr float of_few = 2.365F / 1.96F;

LightOperator make_and_keep(const World& world, const std::filesystem::path& file,
                            const OperatorEffort& effort, const std::string& store,
                            const RunControl& control) {
  expect_to_fit(effort, world.scene, store, "use a machine with more memory");
  LightOperator light(world, light_seed, effort, control);
  light.save(file);
  return light;
}

// A unit on the plan.
struct Placed {
  Transceiver unit;
  std::string key;
  Preview column = {};
  LightStage stage = LightStage::direct;
  std::uint32_t batches = 0;
  std::vector<std::uint32_t> batches_here = {};  // by label, of this process
};

class LightRun : ProgressSink {
 public:
  LightRun(const LightJob& job, Draft draft, const SendFrame& send, const RunControl& control)
      : job_(job),
        draft_(std::move(draft)),
        world_(draft_.scene),
        send_(send),
        control_{control.threads, control.cancel, this} {
    std::vector<Transceiver> chosen;
    for (const std::uint32_t j : chosen_units(scene())) chosen.push_back(scene().transceivers[j]);
    const std::vector<std::uint64_t> keys = light_keys_of(scene(), chosen);
    for (std::size_t k = 0; k < chosen.size(); ++k)
      units_.push_back({.unit = std::move(chosen[k]), .key = unit_key(keys[k])});
    take_known();
  }

  void run() {
    const OperatorEffort usual = usual_effort(scene().labels.size());
    if (const auto kept = LightOperator::load(job_.keep / operator_name, world_, light_seed, usual)) {
      show_previews(*kept, LightStage::fine);
      return refine(*kept);
    }
    show_direct();
    show_previews(
        kept_or_made(world_, job_.keep / coarse_operator_name, coarse_operator, job_.name, control_),
        LightStage::coarse);
    const LightOperator light = make_and_keep(world_, job_.keep / operator_name, usual, job_.name, control_);
    show_previews(light, LightStage::fine);
    refine(light);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto report_interval = std::chrono::milliseconds(250);

  const Scene& scene() const { return draft_.scene; }

  void take_known() {
    std::map<std::string, Placed*> by_key;
    for (Placed& unit : units_) by_key.emplace(unit.key, &unit);
    for (const std::string& frame : job_.known) {
      const Json about = about_of(frame);
      const auto found = by_key.find(about.at("unit").get<std::string>());
      const auto stage = from_text<LightStage>(about.at("stage").get<std::string>());
      if (found == by_key.end() || !stage) continue;
      Placed& unit = *found->second;
      unit.column = column_of(frame);
      if (unit.column.signal.size() != scene().labels.size())
        throw std::out_of_range("a column is of other labels");
      unit.stage = *stage;
      unit.batches = about.at("batches").get<std::uint32_t>();
    }
  }

  void show(const Placed& unit) const {
    send_(column_frame({{"event", "column"},
                        {"generation", job_.generation},
                        {"unit", unit.key},
                        {"stage", to_text(unit.stage)},
                        {"batches", unit.batches}},
                       unit.column));
  }

  void show_direct() {
    say("preparing");
    const std::size_t m = scene().labels.size();
    for (Placed& unit : units_) {
      if (!unit.column.signal.empty()) continue;
      unit.column.signal = direct_column(world_, unit.unit, light_seed);
      unit.column.error.resize(m);
      unit.column.doubts.resize(m);
      show(unit);
    }
  }

  void show_previews(const LightOperator& light, LightStage stage) {
    operator_ = to_text(stage);
    for (Placed& unit : units_) {
      if (unit.stage >= stage && !unit.column.signal.empty()) continue;
      unit.column = light.column(unit.unit);
      unit.stage = stage;
      show(unit);
    }
    say(stage == LightStage::fine ? "refining" : "preparing");
  }

  // Simulates the units without simulated values first, then all units where labels are undecided.
  void refine(const LightOperator& light) {
    if (units_.empty()) return say("none");
    phase_ = "refining";
    std::vector<Placed*> fresh, all;
    for (Placed& unit : units_) {
      all.push_back(&unit);
      if (unit.stage != LightStage::simulated) fresh.push_back(&unit);
    }
    std::optional<UnitRefinement> work;
    if (!fresh.empty()) {
      work.emplace(light, units_of(fresh), light_seed, control_);
      for (const std::uint32_t batches : {min_batches / 2, min_batches}) {
        continue_until(*work, batches, {});
        take(*work, fresh);
      }
    }
    if (fresh.size() < all.size()) work.reset();
    for (;;) {
      const std::vector<std::uint8_t> open = undecided();
      say("refining");
      if (std::find(open.begin(), open.end(), 1) == open.end()) break;
      if (!work) work.emplace(light, units_of(all), light_seed, control_);
      if (!continue_until(*work, std::max(min_batches, 2 * work->most_batches()), open)) break;
      take(*work, all);
    }
    say("done");
  }

  static std::vector<Transceiver> units_of(const std::vector<Placed*>& placed) {
    std::vector<Transceiver> units;
    units.reserve(placed.size());
    for (const Placed* unit : placed) units.push_back(unit->unit);
    return units;
  }

  // Continues until the clusters of labels that are wanted have so many batches, or are precise enough.
  // Returns whether there was anything to do.
  bool continue_until(UnitRefinement& work, std::uint32_t batches, const std::vector<std::uint8_t>& wanted) {
    constexpr std::uint32_t at_once = 2;
    bool has_worked = false;
    while (work.most_batches() < batches) {
      if (control_.cancelled()) throw Interrupted("the light of the shop was not computed completely");
      if (work.add(at_once, finest, control_, wanted) == 0) break;
      has_worked = true;
      say("refining",
          wanted.empty() ? std::optional(static_cast<double>(work.most_batches()) / batches) : std::nullopt);
    }
    return has_worked;
  }

  // Takes the values of units that come from more batches than those of this process, or are more precise
  // than those of an earlier one.
  void take(const UnitRefinement& work, const std::vector<Placed*>& units) {
    for (std::size_t k = 0; k < units.size(); ++k) {
      Placed& unit = *units[k];
      Preview& column = unit.column;
      unit.batches_here.resize(column.signal.size());
      for (std::size_t i = 0; i < column.signal.size(); ++i) {
        const std::uint32_t batches = work.batches(i);
        if (batches < min_batches / 2) continue;
        // Errors of few batches are uncertain.
        const float error = (batches < min_batches ? of_few : 1) * work.standard_error(i, k);
        const bool is_better =
            unit.stage != LightStage::simulated ||
            (unit.batches_here[i] > 0 ? batches > unit.batches_here[i] : error < column.error[i]);
        if (!is_better) continue;
        work.fill(i, k, column);
        column.error[i] = error;
        unit.batches_here[i] = batches;
      }
      unit.stage = LightStage::simulated;
      unit.batches = std::max(unit.batches, std::min(min_batches, work.fewest_batches()));
      show(unit);
    }
  }

  // By label: whether its requirement is within the error.
  std::vector<std::uint8_t> undecided() {
    std::vector<std::uint8_t> open(scene().labels.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      double signal = 0, squares = 0;
      for (const Placed& unit : units_) {
        const auto error = static_cast<double>(unit.column.error[i]);
        signal += static_cast<double>(unit.column.signal[i]);
        squares += error * error;
      }
      open[i] = is_undecided(signal, std::sqrt(squares), requirement(i)) ? 1 : 0;
      count += open[i];
    }
    count_ = count;
    return open;
  }

  double requirement(std::size_t label) const { return scene().requirement_of(scene().labels[label]); }

  void say(const std::string& phase, std::optional<double> progress = {}) {
    phase_ = phase;
    Json about{{"event", "state"},
               {"phase", phase},
               {"operator", operator_.empty() ? Json() : Json(operator_)},
               {"undecided", count_ ? Json(*count_) : Json()},
               {"progress", progress ? Json(*progress) : Json()}};
    send_(column_frame(about, {}));
  }

  void report(Task task, double fraction, std::string_view /*detail*/) override {
    const auto now = Clock::now();
    if (task != Task::preparing || phase_ != "preparing" || now - reported_ < report_interval) return;
    reported_ = now;
    say(phase_, fraction);
  }

  const LightJob& job_;
  const Draft draft_;
  const World world_;
  const SendFrame& send_;
  const RunControl control_;
  std::vector<Placed> units_;
  std::string phase_, operator_;
  std::optional<std::size_t> count_;  // of undecided labels
  Clock::time_point reported_{};
};

}  // namespace

LightOperator kept_or_made(const World& world, const std::filesystem::path& file,
                           const OperatorEffort& effort, const std::string& store,
                           const RunControl& control) {
  if (auto kept = LightOperator::load(file, world, light_seed, effort)) return std::move(*kept);
  return make_and_keep(world, file, effort, store, control);
}

std::string input_of(const LightJob& job) {
  Json head{{"generation", job.generation}, {"name", job.name},        {"folder", job.folder.string()},
            {"keep", job.keep.string()},    {"text", job.text.size()}, {"known", Json::array()}};
  for (const std::string& frame : job.known) head["known"].push_back(frame.size());
  std::string input = head.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n" + job.text;
  for (const std::string& frame : job.known) input += frame;
  return input;
}

LightJob light_job_of(std::string_view input) {
  const std::size_t line = input.find('\n');
  if (line == std::string_view::npos) throw std::out_of_range("the job has no head");
  const Json head = Json::parse(input.substr(0, line));
  std::string_view rest = input.substr(line + 1);
  const auto next = [&](std::size_t size) {
    if (rest.size() < size) throw std::out_of_range("the job is too short");
    std::string part(rest.substr(0, size));
    rest.remove_prefix(size);
    return part;
  };
  LightJob job{.generation = head.at("generation"), .name = head.at("name")};
  job.folder = head.at("folder").get<std::string>();
  job.keep = head.at("keep").get<std::string>();
  job.text = next(head.at("text").get<std::size_t>());
  for (const Json& size : head.at("known")) job.known.push_back(next(size.get<std::size_t>()));
  return job;
}

void run_light(const LightJob& job, const SendFrame& send, const RunControl& control) {
  const ThreadLimit allowed(control.threads);
  with_threads(control.threads, [&] {
    Draft draft = read_draft(JsonCursor::parse(job.text, job.name), job.folder, SceneDetail::surfaces,
                             {.cancel = control.cancel, .allow_links = false});
    if (draft.scene.labels.empty() || draft.scene.mesh.triangles.empty())
      throw InputError(job.name, "has no labels yet", "add labels to see the light that reaches them");
    LightRun(job, std::move(draft), send, control).run();
    return 0;
  });
}

}  // namespace shelfbeam::jobs
