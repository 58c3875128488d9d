#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/spend.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/signal/tables/table_reading.hpp"

#include "jobs/plan_job_json.hpp"
#include "jobs/steps/placement_step.hpp"
#include "jobs/steps/scenarios.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/work.hpp"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace shelfbeam::python {

namespace {

using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Values that a file may not have are refused in arrays, too.
SignalTable table_of(const Values& signals, const std::vector<std::string>& labels,
                     const std::vector<std::string>& units) {
  if (signals.ndim() != 2) throw InputError("signals", "has another shape than labels x units", "correct it");
  const auto at = signals.unchecked<2>();
  if (static_cast<std::size_t>(at.shape(0)) != labels.size() ||
      static_cast<std::size_t>(at.shape(1)) != units.size() || labels.empty() || units.empty())
    throw InputError("signals", "has another shape than labels x units, or is empty", "correct it");
  SignalTable table;
  for (const std::string& id : labels) table.labels.push_back({.id = id});
  for (const std::string& id : units) table.transceivers.push_back({.id = id});
  table.row_begin = {0};
  return watched(0, py::none(), [&](const RunControl& control) {
    for (py::ssize_t i = 0; i < at.shape(0); ++i) {
      expect_running(control.cancel);
      for (py::ssize_t j = 0; j < at.shape(1); ++j) {
        const double signal = at(i, j);
        if (const auto problem = amount_problem(signal); !problem.empty())
          throw InputError(fmt::format("signals[{}, {}]", i, j), std::string(problem), "correct it");
        if (signal > 0) table.entries.push_back({static_cast<std::uint32_t>(j), signal});
      }
      table.row_begin.push_back(table.entries.size());
    }
    return std::move(table);
  });
}

// One value per member of a list of the table.
template <class Members, class Set>
void set_each(Members& members, const Values& values, const char* name, const Set& set) {
  if (values.ndim() != 1) throw InputError(name, "is not a list of numbers", "give one for each");
  const auto at = values.unchecked<1>();
  if (static_cast<std::size_t>(at.shape(0)) != members.size())
    throw InputError(name, fmt::format("has {} values instead of {}", at.shape(0), members.size()),
                     "give one for each");
  for (py::ssize_t k = 0; k < at.shape(0); ++k) {
    if (const auto problem = amount_problem(at(k)); !problem.empty())
      throw InputError(fmt::format("{}[{}]", name, k), std::string(problem), "correct it");
    set(members[static_cast<std::size_t>(k)], at(k));
  }
}

PlacementProblem problem_of(const jobs::PlanJob& job, const SignalTable& table) {
  return resolved(job.plan.problem, table);
}

jobs::PlacementQuestion question_of(const jobs::PlanJob& job) {
  return {job.plan.problem, job.plan.partial, job.plan.curve};
}

// The table with the choice of units and the constraints of a call.
SignalTable chosen(const SignalTable& table, const jobs::PlanJob& job) {
  SignalTable copy = table;
  job.units.apply(copy, "signals");
  job.plan.constraints.apply(copy, "signals");
  check_problem(copy, job.plan.problem);
  return copy;
}

py::dict placed(const SignalTable& table, const std::string& options, const py::object& progress,
                const std::vector<std::string>& start) {
  const jobs::PlanJob job = jobs::parse_plan_job(options, "options");
  const auto [used, answer] = watched(job.threads, progress, [&](const RunControl& control) {
    SignalTable with = chosen(table, job);
    PlaceOptions how = job.plan.place;
    how.seed = job.plan.seed;
    if (!start.empty()) {
      Selection columns;
      for (std::uint32_t j = 0; j < with.columns(); ++j)
        if (std::find(start.begin(), start.end(), with.transceivers[j].id) != start.end())
          columns.push_back(j);
      how.start = jobs::start_of(std::move(columns), with, question_of(job), "start");
    }
    jobs::PlacementAnswer found = jobs::answer(with, question_of(job), how, control);
    return std::pair(std::move(with), std::move(found));
  });
  py::list ids;
  for (const std::uint32_t j : answer.selected) ids.append(used.transceivers[j].id);
  // Those of excluded units are as in the table.
  std::map<std::string, double> price;
  for (const SignalTable::Transceiver& unit : used.transceivers) price[unit.id] = unit.cost;
  std::vector<double> costs;
  for (const SignalTable::Transceiver& unit : table.transceivers) {
    const auto found = price.find(unit.id);
    costs.push_back(found == price.end() ? unit.cost : found->second);
  }
  using py::arg;
  return py::dict(arg("status") = std::string(to_text(answer.status)),
                  arg("has_selection") = answer.has_selection, arg("ids") = ids,
                  arg("reached") = answer.reached, arg("value") = answer.value, arg("bound") = answer.bound,
                  arg("json") = answer.json, arg("text") = answer.text,
                  arg("code") = static_cast<int>(answer.code), arg("seconds") = answer.seconds,
                  arg("costs") = copy_of(costs), arg("steps") = steps_json(answer.steps));
}

py::dict checked(const SignalTable& table, const std::string& options, const Selection& selected) {
  const jobs::PlanJob job = jobs::parse_plan_job(options, "options");
  const PlacementProblem problem = problem_of(job, table);
  expect_numbers(selected, table.columns(), "selection");
  const Check check =
      watched(0, py::none(), [&](const RunControl&) { return check_selection(table, problem, selected); });
  std::vector<double> requirement;
  for (const SignalTable::Label& label : table.labels)
    requirement.push_back(requirement_of(label, problem.model));
  using py::arg;
  return py::dict(arg("signal") = copy_of(check.signal), arg("requirement") = copy_of(requirement),
                  arg("serving") = copy_of(check.serving), arg("missed") = copy_of(check.unmet),
                  arg("allowed") = check.allowed(), arg("cost") = check.transceiver_cost);
}

}  // namespace

void bind_placement(py::module_& module) {
  py::class_<SignalTable>(module, "Table", "Signals with requirements and costs, the input of a placement.")
      .def_static("of_array", table_of)
      .def_static("of_signals",
                  [](const StoredSignals& signals) {
                    return watched(0, py::none(),
                                   [&](const RunControl&) { return make_signal_table(signals, "signals"); });
                  })
      .def_static("read",
                  [](const std::vector<fs::path>& files, const std::string& reading) {
                    const auto form = from_text<TableReading>(reading);
                    if (!form) throw InputError("read_as", "is unknown: " + reading, "use auto");
                    ReadTable read = watched(
                        0, py::none(), [&](const RunControl&) { return jobs::read_scenarios(files, *form); });
                    return std::pair(std::move(read.table), sentences(read.warnings));
                  })
      .def_property_readonly("labels", [](const SignalTable& table) { return ids_of(table.labels); })
      .def_property_readonly("units", [](const SignalTable& table) { return ids_of(table.transceivers); })
      .def("set_requirement",
           [](SignalTable& table, const Values& values) {
             set_each(table.labels, values, "requirement", [](SignalTable::Label& label, double value) {
               label.requirement = label.single_requirement = value;
             });
           })
      .def("set_costs",
           [](SignalTable& table, const Values& values) {
             set_each(table.transceivers, values, "costs",
                      [](SignalTable::Transceiver& unit, double value) { unit.cost = value; });
           })
      .def("set_weights",
           [](SignalTable& table, const Values& values) {
             set_each(table.labels, values, "weights",
                      [](SignalTable::Label& label, double value) { label.weight = value; });
           })
      .def("read_weights", [](SignalTable& table, const fs::path& path) { apply_weights(table, path); })
      .def("read_selection",
           [](const SignalTable& table, const fs::path& path) { return read_selection(path, table); })
      .def("place", placed)
      .def("check", checked);
}

}  // namespace shelfbeam::python
