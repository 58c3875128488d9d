#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jobs/child.hpp"
#include "jobs/preview/light_job.hpp"

namespace shelfbeam::serve {

/// The process that computes light (jobs/preview/light_job.hpp).
class LightChild {
 public:
  /// `program`: shelfbeam.
  explicit LightChild(std::string program) : program_(std::move(program)) {}

  /// Ends the one that is running, if any.
  void start(const jobs::LightJob& job);
  void stop() { child_.reset(); }
  bool is_running() const { return child_.has_value(); }
  void pause() const;
  void resume() const;

  /// The messages since the last call. `failure` becomes the reason if the process has ended with an error.
  std::vector<std::string> poll(std::string& failure);

 private:
  void add_complete_frames(std::vector<std::string>& frames);

  std::string program_;
  std::optional<jobs::Child> child_;
  std::string buffer_;
};

}  // namespace shelfbeam::serve
