#pragma once

#include "shelfbeam/base/error.hpp"

namespace shelfbeam::app {

/// Kinds of the exit codes `wrong_input` and `stopped_early`, by which a batch learns why a plan has ended.
enum ExitDetail : int {
  lacks_memory = 16,      ///< wrong_input
  other_checkpoint = 17,  ///< wrong_input: the checkpoint is damaged, or that of another run
  interrupted = 18        ///< stopped_early by the user, not by a limit
};

/// The variable in the environment of processes that are to end with these codes.
inline constexpr auto exit_detail_variable = "SHELFBEAM_EXIT_DETAILS";

/// The exit code for an error, with details.
int exit_code_of(const InputError& error);

/// The documented exit code, if this process is not to end with details.
int public_exit_code(int code);

}  // namespace shelfbeam::app
