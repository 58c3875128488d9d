#pragma once

#include <exception>
#include <string>

#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam::jobs {

/// How a job or the program has ended.
enum ExitCode : int {
  done = 0,
  answer_is_no = 1,  ///< infeasible, labels missed
  wrong_input = 2,
  stopped_early = 3,  ///< by a limit or the user; the results so far are saved
  internal_error = 4,
  out_of_memory = 5  ///< more than the process may use (wrong_input up to version 0.3)
};

/// The code of an error that ended a job.
ExitCode exit_code_of(const std::exception& error);

/// done, answer_is_no or stopped_early.
ExitCode exit_code_of(Status status);

/// The sentence for out_of_memory without an InputError: `verb` needs it for `input`.
std::string lack_of_memory(const std::string& input, const std::string& verb);

}  // namespace shelfbeam::jobs
