#include "python/calls.hpp"

#include <chrono>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include <pthread.h>

#include "python/bind.hpp"

namespace py = pybind11;

namespace shelfbeam::python {

namespace {

struct Calls {
  Calls() { pthread_atfork(before_fork, after_fork, in_child); }

  // A child has none of the threads that were at work.
  static void before_fork();
  static void after_fork();
  static void in_child();

  std::mutex mutex;
  std::set<CancelToken*> running;
  std::optional<std::thread::id> ending;  // the thread that ends the interpreter
  bool is_torn = false;                   // by a fork
};

Calls& calls() {
  static Calls& all = *new Calls;  // outlives threads that work while the process ends
  return all;
}

void Calls::before_fork() {
  calls().mutex.lock();
}

void Calls::after_fork() {
  calls().mutex.unlock();
}

void Calls::in_child() {
  Calls& all = calls();
  all.is_torn = all.is_torn || !all.running.empty();
  all.running.clear();
  all.mutex.unlock();
}

}  // namespace

RunningCall::RunningCall(CancelToken& cancel) : cancel_(cancel) {
  if (are_over()) {
    PyEval_SaveThread();
    wait_for_exit();
  }
  Calls& all = calls();
  const std::lock_guard lock(all.mutex);
  if (all.is_torn) refuse_fork();
  all.running.insert(&cancel_);
}

RunningCall::~RunningCall() {
  Calls& all = calls();
  const std::lock_guard lock(all.mutex);
  all.running.erase(&cancel_);
}

void refuse_fork() {
  PyErr_SetString(
      PyExc_RuntimeError,
      "this process was forked while another thread was in a call of shelfbeam, so its calls could "
      "hang: start workers by multiprocessing.get_context(\"spawn\"), or before such calls");
  throw py::error_already_set();
}

void end_calls() {
  Calls& all = calls();
  const auto are_at_work = [&] {
    const std::lock_guard lock(all.mutex);
    all.ending = std::this_thread::get_id();
    for (CancelToken* cancel : all.running) cancel->request();
    return !all.running.empty();
  };
  constexpr std::chrono::milliseconds between_looks{2};
  // Reading a file or a solver may not end, and the process has survived them so far.
  constexpr std::chrono::seconds longest{10};
  const auto begun = std::chrono::steady_clock::now();
  const py::gil_scoped_release unlocked;
  while (are_at_work() && std::chrono::steady_clock::now() - begun < longest)
    std::this_thread::sleep_for(between_looks);
}

bool are_over() {
  Calls& all = calls();
  const std::lock_guard lock(all.mutex);
  return all.ending && *all.ending != std::this_thread::get_id();
}

void wait_for_exit() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace shelfbeam::python
