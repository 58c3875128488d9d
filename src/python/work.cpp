#include "python/work.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "jobs/event.hpp"

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
  LatestLine latest;
  jobs::EventProgress events([&](std::string_view line) { latest.put(line); });
  const RunControl control{threads, &cancel, progress.is_none() ? nullptr : &events};
  const auto pass_on = [&] {
    if (const auto line = latest.take()) progress(*line);
  };
  const auto look = [&] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    pass_on();
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
  pass_on();
}

}  // namespace shelfbeam::python
