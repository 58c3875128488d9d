#include "app/exit_details.hpp"

#include <cstdlib>

#include "shelfbeam/base/memory.hpp"

#include "app/verbs.hpp"

namespace shelfbeam::app {

int exit_code_of(const InputError& error) {
  if (error.setting() == Setting::memory || dynamic_cast<const MemoryError*>(&error) != nullptr)
    return lacks_memory;
  // Outputs that cannot be written mention the checkpoint that remains.
  if (error.setting() == Setting::resumption && dynamic_cast<const OutputError*>(&error) == nullptr)
    return other_checkpoint;
  return wrong_input;
}

int public_exit_code(int code) {
  if (std::getenv(exit_detail_variable) != nullptr) return code;
  if (code == lacks_memory || code == other_checkpoint) return wrong_input;
  if (code == interrupted) return stopped_early;
  return code;
}

}  // namespace shelfbeam::app
