#include "shelfbeam/report/messages/comparison.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/report/comparison/comparison_json.hpp"
#include "shelfbeam/report/comparison/comparison_report.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/signal/measured/comparison.hpp"
#include "shelfbeam/signal/measured/measurements.hpp"

#include "python/bind.hpp"
#include "python/work.hpp"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace shelfbeam::python {

namespace {

using py::arg;

py::dict compared(const StoredSignals& signals, const fs::path& measured, const std::vector<ColumnId>& units,
                  double confidence) {
  struct Found {
    std::vector<ComparedPair> pairs;
    Comparison comparison;
  };
  expect_numbers(units, signals.columns(), "placement");
  const Found found = watched(0, py::none(), [&](const RunControl&) {
    const Measurements measurements = read_measurements(measured, signals);
    if (measurements.of_pairs && !units.empty())
      throw InputError(measured.string(), "names a transceiver for every signal, so no units apply",
                       "remove the units, or the column 'transceiver'");
    if (!measurements.of_pairs && units.empty())
      throw InputError(measured.string(), "has no column 'transceiver', so several units were on at once",
                       "name these units");
    std::vector<ComparedPair> pairs = compared_pairs(signals, measurements, units);
    Comparison comparison = compare_signals(pairs, confidence, measured.string());
    return Found{std::move(pairs), std::move(comparison)};
  });
  const ComparisonInput input{signals, found.pairs, found.comparison, measured.filename().string(),
                              "signals"};
  constexpr std::size_t listed = 5;  // as the command line
  return py::dict(arg("json") = comparison_json(input, listed).dump(),
                  arg("statements") = comparison_statements(english(), found.comparison),
                  arg("csv") = comparison_csv(input), arg("html") = comparison_html(english(), input));
}

}  // namespace

void bind_comparison(py::module_& module) {
  module.def("compare", compared);
}

}  // namespace shelfbeam::python
