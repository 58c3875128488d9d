#include "python/work.hpp"

#include <chrono>
#include <future>
#include <mutex>
#include <string>
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
    std::future<void> end = std::async(std::launch::async, [&] { work(control); });
    while (end.wait_for(between_looks) != std::future_status::ready) {
      const py::gil_scoped_acquire locked;
      try {
        look();
      } catch (py::error_already_set& error) {
        raised.emplace(std::move(error));
        cancel.request();
        break;
      }
    }
    end.wait();
    if (!raised) end.get();  // throws as the work
  }
  if (raised) throw std::move(*raised);
  pass_on();
}

}  // namespace shelfbeam::python
