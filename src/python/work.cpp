#include "python/work.hpp"

#include <chrono>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include <unistd.h>

#include "jobs/event.hpp"
#include "python/calls.hpp"

namespace py = pybind11;

namespace shelfbeam::python {

namespace {

// The latest line of events, for another thread.
class LatestLine {
 public:
  void put(std::string_view line) {
    const std::lock_guard lock(mutex_);
    line_ = line;
  }
  std::optional<std::string> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(line_, std::nullopt);
  }

 private:
  std::mutex mutex_;
  std::optional<std::string> line_;
};

// Waits without the interpreter's lock, and takes it again.
template <class Wait>
bool unlocked(const Wait& wait) {
  PyThreadState* const state = PyEval_SaveThread();
  const bool is_over = wait();
  if (are_over()) wait_for_exit();
  in_interpreter([&] { PyEval_RestoreThread(state); });
  return is_over;
}

// By the interface of C, without objects of C++ that would be destroyed without the lock.
void call(const py::object& progress, const std::string& line) {
  const py::str text(line);
  PyObject* const result =
      in_interpreter([&] { return PyObject_CallFunctionObjArgs(progress.ptr(), text.ptr(), nullptr); });
  if (result == nullptr) throw py::error_already_set();
  Py_DECREF(result);
}

}  // namespace

void do_watched(unsigned threads, const py::object& progress,
                const std::function<void(const RunControl&)>& work) {
  constexpr std::chrono::milliseconds between_looks{20};
  CancelToken cancel;
  LatestLine latest;
  jobs::EventProgress events([&](std::string_view line) { latest.put(line); });
  const RunControl control{threads, &cancel, progress.is_none() ? nullptr : &events};
  const auto pass_on = [&] {
    if (const auto line = latest.take()) call(progress, *line);
  };
  const pid_t process = getpid();
  auto running = std::make_unique<RunningCall>(cancel);
  auto end = std::make_unique<std::future<void>>(
      std::async(std::launch::async, [&control, &work, running = std::move(running)]() mutable {
        const auto until_end = std::move(running);
        work(control);
      }));
  std::exception_ptr raised;
  const auto is_over = [&] { return end->wait_for(between_looks) == std::future_status::ready; };
  while (!raised && !unlocked(is_over)) {
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      pass_on();
    } catch (...) {
      raised = std::current_exception();
      cancel.request();
    }
    if (getpid() == process) continue;
    static_cast<void>(end.release());  // the callable has forked: here, the work has no thread
    if (raised) std::rethrow_exception(raised);
    refuse_fork();
  }
  while (raised && !unlocked(is_over)) continue;
  if (raised) std::rethrow_exception(raised);
  end->get();  // throws as the work
  pass_on();
}

}  // namespace shelfbeam::python
