#pragma once

#include <string_view>

#include "shelfbeam/base/control.hpp"

namespace shelfbeam {

/// Passes progress on, but no incumbents and bounds: those of a question beside that of the run.
class ProgressAlone final : public ProgressSink {
 public:
  explicit ProgressAlone(ProgressSink* watcher) : watcher_(watcher) {}
  void report(Task task, double fraction, std::string_view detail) override {
    if (watcher_ != nullptr) watcher_->report(task, fraction, detail);
  }

 private:
  ProgressSink* watcher_;
};

}  // namespace shelfbeam
