#pragma once

#include <cstddef>
#include <cstdint>

#include <pybind11/pybind11.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/ids.hpp"

/// Numbers of labels and columns are whole numbers in Python.
template <class Tag>
struct pybind11::detail::type_caster<shelfbeam::Number<Tag>> {
  PYBIND11_TYPE_CASTER(shelfbeam::Number<Tag>, const_name("int"));

  bool load(handle from, bool converts) {
    make_caster<std::uint32_t> number;
    if (!number.load(from, converts)) return false;
    value = cast_op<std::uint32_t>(number);
    return true;
  }
  static handle cast(shelfbeam::Number<Tag> number, return_value_policy policy, handle parent) {
    return make_caster<std::uint32_t>::cast(std::uint32_t{number}, policy, parent);
  }
};

namespace shelfbeam::python {

/// Throws InputError unless all numbers are those of members of a list.
template <class Numbers>
void expect_numbers(const Numbers& numbers, std::size_t members, const char* name) {
  for (const auto number : numbers)
    if (number >= members) throw InputError(name, "has a number without a member", "correct it");
}

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
