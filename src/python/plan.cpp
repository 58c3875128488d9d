#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/plan/io/scene_table.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/report/messages/end_reason.hpp"
#include "shelfbeam/report/messages/open_bound.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/signals.hpp"
#include "shelfbeam/report/terminal/coverage_text.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"
#include "shelfbeam/report/terminal/plan_text.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

#include "jobs/plan_job_json.hpp"
#include "jobs/report_job.hpp"
#include "jobs/steps/verification_step.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/shop.hpp"
#include "python/work.hpp"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace shelfbeam::python {

namespace {

using py::arg;

// The lines of the command line, with keywords instead of flags.
py::dict result(const jobs::PlanJob& job, const jobs::PlanEnd& end) {
  const Plan& plan = end.plan;
  PlanText text = plan_text(plan, end.table);
  if (plan.certificate) text.answer = with_effort(english(), text.answer, plan.certificate->open);
  Remedy remedy = remedy_for(english(), plan);
  for (const Setting setting : remedy.settings) {
    std::string keyword(to_text(setting));
    std::replace(keyword.begin(), keyword.end(), '-', '_');
    if (!keyword.empty()) remedy.advice += fmt::format(" ({})", keyword);
  }
  if (!text.basis.empty()) text.details.insert(0, text.basis + '\n');
  text.details += describe(plan.alternatives, plan.placement, end.table, plan.has_known_thresholds()) +
                  describe(plan.curve, end.table);
  if (plan.sensitivity) text.details += sensitivity_sentence(english(), plan, end.table.rows()) + '\n';
  const SimulationSummary& summary = plan.simulation.summary;
  std::string given;
  if (plan.signals)
    given = signals_text(english(), *plan.signals, summary.labels, summary.candidates, job.signal->string());
  return py::dict(arg("code") = static_cast<int>(end.code), arg("imprecise") = end.is_imprecise,
                  arg("answer") = text.answer, arg("open") = remedy.after(text.open),
                  arg("details") = text.details, arg("given") = given,
                  arg("misfit") = plan.signals && std::holds_alternative<MisfitReason>(*plan.signals));
}

// Cancelled, the results so far are in the folder, as those of the command line.
py::dict planned(const Shop& shop, const std::string& options, const py::object& progress) {
  const jobs::PlanJob job = jobs::parse_plan_job(options, "options");
  jobs::PlanEnd end;
  try {
    do_watched(job.threads, progress, [&](const RunControl& control) {
      Store store = jobs::with_choice(shop.store, job);
      store.cancel = control.cancel;
      end =
          jobs::run_plan(job, std::move(store), {.cancel = control.cancel, .progress = control.progress}, {});
    });
  } catch (py::error_already_set& stop) {
    const fs::path kept = end.elsewhere.value_or(end.is_kept ? fs::path() : job.folder);
    if (!end.answer.empty() && !kept.empty() && py::hasattr(stop.value(), "add_note"))
      stop.value().attr("add_note")("the plan so far is in " + kept.string());
    throw;
  }
  return result(job, end);
}

// Mounted units: the ids, the file, or those that the store chooses.
jobs::Installation installation(const Shop& shop, const jobs::PlanJob& job,
                                const std::optional<Selection>& units, const CancelToken* cancel) {
  Store store = shop.store;
  store.cancel = cancel;
  leave_out(store, job.without);
  if (units) {
    expect_numbers(*units, shop.scene.transceivers.size(), "selection");
    // The question is that of a file with these units, and so are its random numbers.
    PlacementProblem problem;
    problem.model = job.model.value_or(problem.model);
    problem.redundant = job.plan.problem.redundant;
    Scene mounted = with_units(shop.scene, *units);
    if (distinct_positions(positions_of(mounted.transceivers)).count < units->size())
      throw InputError("selection", "has two units at one mounting point", "choose one of them");
    return {std::move(store), std::move(mounted), problem};
  }
  const fs::path file = job.selection.value_or("");
  jobs::Installation found = jobs::installation_of(std::move(store), file, job.store);
  found.problem.model = job.model.value_or(found.problem.model);
  found.problem.redundant = found.problem.redundant || job.plan.problem.redundant;
  return found;
}

py::dict verdicts(const Certificate& certificate, const CertifiedPlan& verified, const Scene& scene) {
  py::list verdict;
  std::vector<double> requirement, signal, error, lower, upper;
  for (const LabelVerdict& label : certificate.labels) {
    verdict.append(std::string(to_text(label.verdict)));
    requirement.push_back(label.requirement);
    signal.push_back(label.signal);
    error.push_back(label.standard_error);
    lower.push_back(label.lower);
    upper.push_back(label.upper);
  }
  const std::string sentence =
      with_effort(english(), certificate_sentence(english(), verified), certificate.open);
  return py::dict(
      arg("code") = static_cast<int>(jobs::exit_code_of(certificate)), arg("answer") = sentence,
      arg("json") = certificate_json(certificate, table_without_signals(scene)),
      arg("csv") = verification_csv(certificate, scene), arg("units") = ids_of(scene.transceivers),
      arg("verdict") = verdict, arg("requirement") = copy_of(requirement), arg("signal") = copy_of(signal),
      arg("standard_error") = copy_of(error), arg("lower") = copy_of(lower), arg("upper") = copy_of(upper));
}

py::dict verified(const Shop& shop, const std::string& options, const py::object& progress,
                  const std::optional<Selection>& units) {
  const jobs::PlanJob job = jobs::parse_plan_job(options, "options");
  const SimulationOptions simulation = job.plan.simulation.options(job.plan.seed);
  if (job.plan.states.value_or(0) > 0) {
    const auto [found, mounted] = watched(job.threads, progress, [&](const RunControl& control) {
      jobs::Installation units_of_store = installation(shop, job, units, control.cancel);
      expect_variation(units_of_store.store);
      const VerifyStatesOptions how{*job.plan.states, job.plan.goal, job.plan.confidence, simulation};
      ResultLog log = log_of_states("", shop.scene.store_hash, simulation);
      Availability availability = jobs::verify_in_states(units_of_store, how, log, control);
      return std::pair(std::move(availability), std::move(units_of_store));
    });
    const SignalTable table = table_without_signals(mounted.scene);
    Placement placement;
    placement.problem = mounted.problem;
    placement.selected = all_numbers<ColumnId>(mounted.scene.transceivers.size());
    return py::dict(arg("code") = static_cast<int>(jobs::exit_code_of(found)),
                    arg("answer") = availability_answer(found, placement, table),
                    arg("json") = availability_text(found, table),
                    arg("csv") = availability_csv(found, mounted.scene),
                    arg("units") = ids_of(mounted.scene.transceivers));
  }
  expect_no_goal(job.plan.goal, job.without);
  const auto [found, scene] = watched(job.threads, progress, [&](const RunControl& control) {
    jobs::Installation mounted = installation(shop, job, units, control.cancel);
    CertifyOptions how;
    how.confidence = job.plan.confidence;
    how.budget.seconds = job.plan.budget_s;
    how.simulation = simulation;
    CertifiedPlan certified = verify_installation(mounted.scene, mounted.problem, how, control);
    return std::pair(std::move(certified), std::move(mounted.scene));
  });
  return verdicts(*found.certificate, found, scene);
}

}  // namespace

void bind_plan(py::module_& module) {
  module.def("plan", planned);
  module.def("verify", verified);
  module.def(
      "rebuild_report", [](const fs::path& folder, bool safe_csv, const std::optional<fs::path>& store) {
        return watched(0, py::none(),
                       [&](const RunControl&) { return jobs::rebuild_report(folder, safe_csv, store); });
      });
}

}  // namespace shelfbeam::python
