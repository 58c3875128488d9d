#pragma once

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include <pybind11/pybind11.h>

#include "shelfbeam/base/control.hpp"

namespace shelfbeam::python {

/// Does `work` on a thread of its own, without the interpreter's lock. Meanwhile, passes the progress on to
/// `progress` (None, or a callable that gets lines of EventProgress), and looks for signals. On Ctrl-C, or if
/// `progress` raises, cancels the work, waits for its end, and raises. Requires the lock.
void do_watched(unsigned threads, const pybind11::object& progress,
                const std::function<void(const RunControl&)>& work);

/// The same for work with a result.
template <class Work>
auto watched(unsigned threads, const pybind11::object& progress, const Work& work) {
  std::optional<std::invoke_result_t<Work, const RunControl&>> result;
  do_watched(threads, progress, [&](const RunControl& control) { result.emplace(work(control)); });
  return std::move(*result);
}

}  // namespace shelfbeam::python
