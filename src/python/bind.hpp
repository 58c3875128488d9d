#pragma once

#include <pybind11/pybind11.h>

namespace shelfbeam::python {

// Each function adds the classes and functions of one subject to the module. docs/python.md and the package
// shelfbeam document them; _core.pyi has their types.
void bind_errors();
void bind_scene(pybind11::module_& module);
void bind_signals(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_placement(pybind11::module_& module);
void bind_plan(pybind11::module_& module);
void bind_preview(pybind11::module_& module);
void bind_comparison(pybind11::module_& module);

}  // namespace shelfbeam::python
