#include <cstdint>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/matrix_export.hpp"

#include "jobs/stored_plan.hpp"
#include "python/arrays.hpp"
#include "python/bind.hpp"
#include "python/work.hpp"

namespace py = pybind11;

namespace shelfbeam::python {

namespace {

py::ssize_t signed_size(std::size_t count) {
  return static_cast<py::ssize_t>(count);
}

// An array of the matrix, m x n.
template <class T>
py::object entries(const py::object& self, const std::vector<T>& values) {
  const auto& matrix = self.cast<const StoredSignals&>();
  if (values.empty()) return py::none();
  return view_of(values.data(), {signed_size(matrix.rows()), signed_size(matrix.columns())}, self);
}

py::list pairs_of(const py::object& self, const std::vector<SignalLayer>& layers) {
  py::list list;
  for (const SignalLayer& layer : layers)
    list.append(py::make_tuple(entries(self, layer.mean), entries(self, layer.standard_error)));
  return list;
}

py::dict label_rows(const StoredSignals& signals) {
  py::list id, type, position, normal, requirement, link_cost, signal_cost, batches, samples;
  for (const LabelRow& label : signals.labels) {
    id.append(label.id);
    type.append(label.type);
    position.append(numbers(label.position));
    normal.append(numbers(label.normal));
    requirement.append(label.requirement);
    link_cost.append(label.link_cost);
    signal_cost.append(label.signal_cost);
    batches.append(label.batches);
    samples.append(label.samples);
  }
  using py::arg;
  return py::dict(arg("id") = id, arg("type") = type, arg("position") = position, arg("normal") = normal,
                  arg("requirement") = requirement, arg("link_cost") = link_cost,
                  arg("signal_cost") = signal_cost, arg("batches") = batches, arg("samples") = samples);
}

py::dict unit_columns(const StoredSignals& signals) {
  py::list id, type, position, axis, cost, installed, pinned;
  for (const TransceiverColumn& unit : signals.transceivers) {
    id.append(unit.id);
    type.append(unit.type);
    position.append(numbers(unit.position));
    axis.append(numbers(unit.axis));
    cost.append(unit.cost);
    installed.append(unit.installed);
    pinned.append(unit.pinned);
  }
  using py::arg;
  return py::dict(arg("id") = id, arg("type") = type, arg("position") = position, arg("axis") = axis,
                  arg("cost") = cost, arg("installed") = installed, arg("pinned") = pinned);
}

// The same matrix with other means, for placements on them.
std::shared_ptr<StoredSignals> with_mean(
    const StoredSignals& signals, const py::array_t<float, py::array::c_style | py::array::forcecast>& mean) {
  if (mean.ndim() != 2 || mean.shape(0) != signed_size(signals.rows()) ||
      mean.shape(1) != signed_size(signals.columns()))
    throw InputError("mean", "has another shape than the signals", "give one value per label and unit");
  auto copy = std::make_shared<StoredSignals>(signals);
  copy->mean.assign(mean.data(), mean.data() + mean.size());
  for (const float value : copy->mean)
    if (const auto problem = amount_problem(value); !problem.empty())
      throw InputError("mean", fmt::format("has a value that {}", problem), "correct it");
  return copy;
}

// Deviation between states, and the signals of the hardest labels: state x label x unit.
py::object states_of(const py::object& self) {
  const auto& signals = self.cast<const StoredSignals&>();
  if (!signals.states) return py::none();
  const StateTensor& states = *signals.states;
  const std::vector<py::ssize_t> shape{signed_size(states.states), signed_size(states.hard.size()),
                                       signed_size(signals.columns())};
  const auto tensor = [&](const std::vector<float>& values) {
    return values.empty() ? py::object(py::none()) : view_of(values.data(), shape, self);
  };
  using py::arg;
  return py::dict(arg("count") = states.states, arg("deviation") = entries(self, states.deviation),
                  arg("labels") = view_of(states.hard.data(), {signed_size(states.hard.size())}, self),
                  arg("signal") = tensor(states.signal), arg("error") = tensor(states.error));
}

}  // namespace

void bind_signals(py::module_& module) {
  using Signals = StoredSignals;
  const auto array = [](auto member) {
    return [member](const py::object& self) { return entries(self, self.cast<const Signals&>().*member); };
  };
  py::class_<Signals, std::shared_ptr<Signals>>(module, "Signals", "The signal matrix of a scene.")
      .def_static("read",
                  [](const std::filesystem::path& path) {
                    return watched(0, py::none(), [&](const RunControl&) {
                      return std::make_shared<Signals>(jobs::read_given_signals(path));
                    });
                  })
      .def("write",
           [](const Signals& signals, const std::filesystem::path& path) {
             do_watched(0, py::none(), [&](const RunControl&) { write_signal_file(signals, path); });
           })
      .def("with_mean", with_mean)
      .def_property_readonly("rows", [](const Signals& signals) { return signals.rows(); })
      .def_property_readonly("columns", [](const Signals& signals) { return signals.columns(); })
      .def_property_readonly("mean", array(&Signals::mean))
      .def_property_readonly("standard_error", array(&Signals::standard_error))
      .def_property_readonly("direct", array(&Signals::direct))
      .def_property_readonly("flags", array(&Signals::flags))
      .def_property_readonly(
          "by_bounce",
          [](const py::object& self) { return pairs_of(self, self.cast<const Signals&>().by_bounce); })
      .def_property_readonly(
          "by_length",
          [](const py::object& self) { return pairs_of(self, self.cast<const Signals&>().by_length); })
      .def_property_readonly("length_step", [](const Signals& signals) { return signals.length_step; })
      .def_property_readonly("wavelength_nm", [](const Signals& signals) { return signals.wavelength_nm; })
      .def_property_readonly("currency", [](const Signals& signals) { return signals.currency; })
      .def_property_readonly("seed", [](const Signals& signals) { return signals.provenance.seed; })
      .def_property_readonly("estimator", [](const Signals& signals) { return signals.provenance.estimator; })
      .def_property_readonly("store_hash",
                             [](const Signals& signals) { return signals.provenance.store_hash; })
      .def_property_readonly("complete", [](const Signals& signals) { return signals.provenance.complete; })
      .def("labels", label_rows)
      .def("units", unit_columns)
      .def("states", states_of);
}

}  // namespace shelfbeam::python
