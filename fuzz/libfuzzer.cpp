#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <pthread.h>
#include <sanitizer/common_interface_defs.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"

#include "reader.hpp"

// What libFuzzer calls; SHELFBEAM_READER is the name of the reader of this program.

namespace {

const shelfbeam::fuzz::Reader& reader() {
  static const shelfbeam::fuzz::Reader* found = shelfbeam::fuzz::find_reader(SHELFBEAM_READER);
  if (found == nullptr) {
    std::fputs("no reader is called " SHELFBEAM_READER "\n", stderr);
    std::abort();
  }
  return *found;
}

// A child process that a reader begins may crash or ask for too much (signal/detail/child_process.hpp): that
// is no finding. What libFuzzer would write of it goes to a relative path, which the child does not have.
const int quiet_children = ::pthread_atfork(nullptr, nullptr, [] {
  __sanitizer_set_death_callback(nullptr);
  if (::chdir("/") != 0) std::abort();
});

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): the names are libFuzzer's.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    reader().read({reinterpret_cast<const char*>(data), size});
  } catch (const shelfbeam::InputError&) {
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  size = LLVMFuzzerMutate(data, size, max_size);
  // Now and then the checksums stay wrong.
  if (reader().repair == nullptr || seed % 8 == 0) return size;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  reader().repair(bytes);
  std::memcpy(data, bytes.data(), size);
  return size;
}
// NOLINTEND(readability-identifier-naming)
