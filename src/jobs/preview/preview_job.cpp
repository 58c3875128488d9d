#include "jobs/preview/preview_job.hpp"

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/plan/preview/given_unit.hpp"
#include "shelfbeam/plan/question/fitting_signals.hpp"
#include "shelfbeam/plan/store/given_units.hpp"
#include "shelfbeam/report/messages/signals.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/transport/operator/light_operator.hpp"
#include "shelfbeam/transport/operator/unit_refinement.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

#include "jobs/plan_folder.hpp"
#include "jobs/stored_plan.hpp"

namespace shelfbeam::jobs {

namespace {

namespace fs = std::filesystem;

Preview column_of(const SignalMatrix& matrix, std::size_t unit) {
  Preview column;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    column.signal.push_back(static_cast<float>(matrix.signal(i, unit)));
    column.error.push_back(matrix.standard_error[matrix.at(i, unit)]);
  }
  column.doubts.resize(matrix.rows());
  return column;
}

// The mounted units are found by their light, which an id alone may not have in another store.
UnitsBefore units_of_plan(const fs::path& folder, const Scene& scene) {
  constexpr auto remedy = "name the store of the plan, or plan the store again";
  const StoredPlan stored = read_stored_plan(folder);
  StoredSignals given = read_given_signals(folder);
  std::vector<TransceiverColumn> mounted;
  for (const std::uint32_t j : stored.plan.placement.selected) mounted.push_back(given.transceivers.at(j));
  auto fitting = fitting_signals(std::move(given), scene, SimulationOptions().rules());
  if (const auto* reason = std::get_if<MisfitReason>(&fitting))
    throw InputError(folder.string(),
                     fmt::format("does not fit the store, because {}", reason_text(english(), *reason)),
                     remedy);
  UnitsBefore units{.problem = stored.plan.placement.problem};
  const auto& matrix = std::get<SignalMatrix>(fitting);
  const auto& columns = matrix.transceivers;
  for (const TransceiverColumn& unit : mounted) {
    const auto is_same = [&](const TransceiverColumn& column) {
      return column.light == unit.light && column.position == unit.position;
    };
    auto found = std::find_if(columns.begin(), columns.end(), [&](const TransceiverColumn& column) {
      return is_same(column) && column.id == unit.id;
    });
    if (found == columns.end()) found = std::find_if(columns.begin(), columns.end(), is_same);
    if (found == columns.end())
      throw InputError(folder.string(),
                       fmt::format("mounts {}, which the store does not have there", in_quotes(unit.id)),
                       remedy);
    units.ids.push_back(found->id);
    units.columns.push_back(column_of(matrix, static_cast<std::size_t>(found - columns.begin())));
  }
  return units;
}

std::vector<std::string> ids_of(const std::vector<Transceiver>& units) {
  std::vector<std::string> ids;
  ids.reserve(units.size());
  for (const Transceiver& unit : units) ids.push_back(unit.id);
  return ids;
}

// Reads the operator, or computes and keeps it. A folder that cannot be written costs the next preview time.
LightOperator operator_of(const PreviewJob& job, const World& world, const RunControl& control,
                          PreviewResult& result) {
  const OperatorEffort usual = usual_effort(world.scene.labels.size());
  const fs::path file = job.plan / operator_name;
  if (!job.plan.empty())
    if (auto kept = LightOperator::load(file, world, job.seed, usual)) return std::move(*kept);
  const OperatorEffort effort = job.coarse ? coarse_operator : usual;
  expect_to_fit(effort, world.scene, job.store.string(),
                job.coarse ? "use a machine with more memory"
                           : "preview it with less effort, or on a machine with more memory");
  if (job.coarse || job.plan.empty()) return {world, job.seed, effort, control};
  LightOperator light(world, job.seed, effort, control);
  try {
    light.save(file);
  } catch (const OutputError& error) {
    result.not_kept = error.what();
  }
  return light;
}

// Replaces previews by unbiased signals, as far as the time or a cancellation allows.
void refine(const LightOperator& light, const std::vector<Transceiver>& units, double seconds,
            std::uint64_t seed, const RunControl& control, std::vector<Preview>& previews) {
  using Clock = std::chrono::steady_clock;
  constexpr std::uint32_t at_once = 2;
  constexpr double target = 0.002;  // of the requirement
  const auto start = Clock::now();
  const auto share = [&] {
    return std::min(1.0, std::chrono::duration<double>(Clock::now() - start).count() / seconds);
  };
  UnitRefinement refinement(light, units, seed, control);
  while (!control.cancelled() && (share() < 1 || refinement.fewest_batches() < min_batches)) {
    if (refinement.add(at_once, target, control) == 0) break;
    control.report(Task::refining, share());
  }
  for (std::size_t k = 0; k < units.size(); ++k) refinement.fill(k, previews[k]);
}

std::vector<Preview> previews_of(const PreviewJob& job, const std::vector<Transceiver>& units,
                                 const World& world, const RunControl& control, PreviewResult& result) {
  if (units.empty()) return {};
  const LightOperator light = operator_of(job, world, control, result);
  std::vector<Preview> previews;
  previews.reserve(units.size());
  for (const Transceiver& unit : units) previews.push_back(light.column(unit));
  if (!job.refine_s) return previews;
  try {
    refine(light, units, *job.refine_s, job.seed, control, previews);
  } catch (const Interrupted&) {
    // Previews remain.
  }
  result.is_stopped = control.cancelled();
  return previews;
}

}  // namespace

void expect_to_fit(const OperatorEffort& effort, const Scene& scene, const std::string& store,
                   const std::string& remedy) {
  const double bytes = effort.bytes(scene);
  if (bytes <= static_cast<double>(memory_limit())) return;
  throw MemoryError(
      store,
      fmt::format("its light requires about {:.3g} GB of memory, more than is available", 1e-9 * bytes),
      remedy);
}

PreviewResult run_preview(const PreviewJob& job, const RunControl& control) {
  const Store store = read_store(job.store, {.allow_outside = job.allow_outside, .cancel = control.cancel});
  return run_preview(job, make_scene(store), control);
}

PreviewResult run_preview(const PreviewJob& job, Scene shop, const RunControl& control) {
  const ThreadLimit allowed(control.threads);
  return with_threads(control.threads, [&] {
    PreviewResult result;
    result.scene = std::move(shop);
    const Scene& scene = result.scene;
    WhatIf change;
    change.removed = job.removed;
    for (const std::string& text : job.added)
      change.added.push_back(given_unit(text, scene, fmt::format("new-{}", change.added.size() + 1)));
    for (const std::string& text : job.moved) {
      MovedUnit moved = moved_unit(text, scene);
      change.removed.push_back(std::move(moved.id));
      change.added.push_back(std::move(moved.unit));
    }
    // Units of the store are previewed like added ones.
    std::vector<Transceiver> units;
    if (job.plan.empty())
      for (const std::uint32_t j : chosen_units(scene)) units.push_back(scene.transceivers[j]);
    const std::size_t chosen = units.size();
    std::optional<UnitsBefore> before;
    if (!job.plan.empty())
      before = units_of_plan(job.plan, scene);
    else if (chosen > 0)
      before = UnitsBefore{.ids = ids_of(units)};
    kept_units(before, change.removed);  // refuses wrong ids before the work
    units.insert(units.end(), change.added.begin(), change.added.end());
    if (units.empty() && !before)
      throw InputError(job.store.string(), "selects no unit, and none is added",
                       "add a unit, or list ids in transceivers.selected");
    std::vector<Preview> previews;
    if (!units.empty()) previews = previews_of(job, units, World(scene), control, result);
    for (std::size_t k = 0; k < chosen; ++k) before->columns.push_back(std::move(previews[k]));
    change.is_simulated = units.empty() || (job.refine_s && !result.is_stopped);
    result.what_if = what_if(scene, before, std::move(change), std::span(previews).subspan(chosen));
    return result;
  });
}

}  // namespace shelfbeam::jobs
