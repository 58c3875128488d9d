#include "jobs/exit_code.hpp"

#include <new>
#include <system_error>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"

namespace shelfbeam::jobs {

ExitCode exit_code_of(const std::exception& error) {
  if (const auto* input = dynamic_cast<const InputError*>(&error)) {
    const bool lacks_memory =
        input->setting() == Setting::memory || dynamic_cast<const MemoryError*>(input) != nullptr;
    return lacks_memory ? out_of_memory : wrong_input;
  }
  if (dynamic_cast<const Interrupted*>(&error) != nullptr) return stopped_early;
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return out_of_memory;
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  const bool lacks_memory =
      system != nullptr && (system->code() == std::errc::not_enough_memory ||
                            system->code() == std::errc::resource_unavailable_try_again);
  return lacks_memory ? out_of_memory : internal_error;
}

ExitCode exit_code_of(Status status) {
  if (status == Status::infeasible) return answer_is_no;
  return status == Status::stopped ? stopped_early : done;
}

std::string lack_of_memory(const std::string& input, const std::string& verb) {
  return fmt::format(
      "{}: '{}' requires more than {:.3g} GB of memory, which is all that this process may use; "
      "use a smaller input, or a machine with more memory",
      input, verb, 1.25e-9 * static_cast<double>(memory_limit()));
}

}  // namespace shelfbeam::jobs
