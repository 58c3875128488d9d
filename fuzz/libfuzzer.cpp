#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "shelfbeam/base/error.hpp"

#include "reader.hpp"

// The functions that libFuzzer calls. SHELFBEAM_READER is the name of this program's reader.

namespace {

const shelfbeam::fuzz::Reader& reader() {
  static const shelfbeam::fuzz::Reader* found = shelfbeam::fuzz::find_reader(SHELFBEAM_READER);
  if (found == nullptr) {
    std::fputs("no reader is called " SHELFBEAM_READER "\n", stderr);
    std::abort();
  }
  return *found;
}

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
  // One input in eight keeps wrong checksums.
  if (reader().repair == nullptr || seed % 8 == 0) return size;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  reader().repair(bytes);
  std::memcpy(data, bytes.data(), size);
  return size;
}
// NOLINTEND(readability-identifier-naming)
