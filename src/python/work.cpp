#include "python/work.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "jobs/progress.hpp"
#include "python/bind.hpp"

namespace py = pybind11;

namespace shelfbeam::python {

namespace {

using Clock = std::chrono::steady_clock;

// A state of the work, as the callback gets it.
struct CallProgress {
  std::string task, detail;
  std::optional<double> fraction, seconds_left, incumbent, lower_bound;
};

std::optional<double> if_known(double value) {
  return value < 0 ? std::nullopt : std::optional(value);
}

// The latest state, for another thread.
class LatestProgress : public ProgressSink {
 public:
  void report(Task task, double fraction, std::string_view detail) override {
    const std::lock_guard lock(mutex_);
    const double now = std::chrono::duration<double>(Clock::now() - begun_).count();
    const jobs::Progress shown = stages_.update(task, fraction, detail, now);
    latest_.task = std::string(to_text(shown.task));
    latest_.detail = shown.detail;
    latest_.fraction = if_known(shown.fraction);
    latest_.seconds_left = if_known(shown.seconds_left);
    is_new_ = true;
  }
  void bounds(double incumbent, double lower_bound) override {
    const std::lock_guard lock(mutex_);
    latest_.incumbent = incumbent;
    latest_.lower_bound = lower_bound;
    is_new_ = true;
  }
  std::optional<CallProgress> take() {
    const std::lock_guard lock(mutex_);
    if (!is_new_ || latest_.task.empty()) return {};
    is_new_ = false;
    return latest_;
  }

 private:
  std::mutex mutex_;
  jobs::ProgressStages stages_;
  CallProgress latest_;
  bool is_new_ = false;
  Clock::time_point begun_ = Clock::now();
};

// A thread that does some work once.
class Worker {
 public:
  explicit Worker(const std::function<void()>& work)
      : thread_([this, work] {
          try {
            work();
          } catch (...) {
            thrown_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          has_ended_ = true;
          ended_.notify_all();
        }) {}
  ~Worker() { thread_.join(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  bool wait(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, most, [this] { return has_ended_; });
  }
  void wait() {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return has_ended_; });
  }
  // Precondition: it has ended.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::exception_ptr thrown_;
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace

void do_watched(unsigned threads, const py::object& progress,
                const std::function<void(const RunControl&)>& work) {
  constexpr std::chrono::milliseconds between_looks{20};
  CancelToken cancel;
  LatestProgress latest;
  const RunControl control{threads, &cancel, progress.is_none() ? nullptr : &latest};
  const auto look = [&] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress.is_none()) return;
    if (const auto state = latest.take()) progress(*state);
  };
  std::optional<py::error_already_set> raised;
  {
    const py::gil_scoped_release unlocked;
    Worker worker([&] { work(control); });
    while (!worker.wait(between_looks)) {
      const py::gil_scoped_acquire locked;
      try {
        look();
      } catch (py::error_already_set& error) {
        raised.emplace(std::move(error));
        cancel.request();
        break;
      }
    }
    worker.wait();
    if (!raised) worker.rethrow();
  }
  if (raised) throw std::move(*raised);
  if (!progress.is_none())
    if (const auto state = latest.take()) progress(*state);
}

void bind_progress(py::module_& module) {
  py::class_<CallProgress>(module, "Progress", "The state of a long call.")
      .def_readonly("task", &CallProgress::task)
      .def_readonly("detail", &CallProgress::detail)
      .def_readonly("fraction", &CallProgress::fraction)
      .def_readonly("seconds_left", &CallProgress::seconds_left)
      .def_readonly("incumbent", &CallProgress::incumbent)
      .def_readonly("lower_bound", &CallProgress::lower_bound)
      .def("__repr__", [](const CallProgress& state) {
        return "<Progress: " + state.task + (state.detail.empty() ? "" : ", " + state.detail) + ">";
      });
}

}  // namespace shelfbeam::python
