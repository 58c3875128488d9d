#include <string>

#include "shelfbeam/base/provenance.hpp"

#include "python/bind.hpp"
#include "python/calls.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace shelfbeam::python;
  module.doc() = "The compiled part of the package shelfbeam, which is the interface.";
  module.attr("__version__") = std::string(shelfbeam::program_version());
  bind_errors();
  bind_scene(module);
  bind_signals(module);
  bind_simulation(module);
  bind_placement(module);
  bind_plan(module);
  bind_preview(module);
  bind_comparison(module);
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(end_calls));
}
