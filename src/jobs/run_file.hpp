#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "shelfbeam/plan/plan.hpp"

namespace shelfbeam::jobs {

/// The effort of a run as a whole.
struct RunEffort {
  double wall_s = 0, cpu_s = 0;
  std::uint64_t peak_memory = 0;  ///< bytes
  unsigned threads = 0;
};

/// Measures the effort of this process from the construction of the object on.
class RunClock {
 public:
  RunClock();
  RunEffort effort(unsigned threads) const;

 private:
  double wall_, cpu_;
};

/// run.json (docs/formats/report.md): the values in which two runs with the same result differ. All other
/// files of a plan are the same bytes for the same result. `store`: the path of the store file from the
/// folder of the plan; may be empty.
std::string run_json(const Plan& plan, const RunEffort& effort, const std::string& store);

/// Whether the file is as a run wrote it.
bool is_run_file(const std::filesystem::path& file);

}  // namespace shelfbeam::jobs
