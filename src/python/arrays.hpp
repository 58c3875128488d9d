#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/math/vec3.hpp"

/// Numbers of labels and columns are whole numbers in NumPy.
template <class Tag>
struct pybind11::detail::npy_format_descriptor<shelfbeam::Number<Tag>>
    : npy_format_descriptor<std::uint32_t> {
  static_assert(sizeof(shelfbeam::Number<Tag>) == sizeof(std::uint32_t));
};

namespace shelfbeam::python {

/// A read-only array over memory that `owner` keeps alive.
template <class T>
pybind11::array view_of(const T* data, std::vector<pybind11::ssize_t> shape, const pybind11::handle& owner) {
  pybind11::array_t<T> array(std::move(shape), data, owner);
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

/// An array with a copy of the values.
template <class T>
pybind11::array copy_of(const std::vector<T>& values) {
  return pybind11::array(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

inline pybind11::list numbers(const Vec3& v) {
  pybind11::list list;
  for (const double value : {v.x, v.y, v.z}) list.append(value);
  return list;
}

/// Corners as pairs.
inline pybind11::list corners(const Polygon& polygon) {
  pybind11::list list;
  for (const Vec2& p : polygon) list.append(pybind11::make_tuple(p[0], p[1]));
  return list;
}

/// The ids of labels or units.
template <class Members>
pybind11::list ids_of(const Members& members) {
  pybind11::list ids;
  for (const auto& member : members) ids.append(member.id);
  return ids;
}

}  // namespace shelfbeam::python
