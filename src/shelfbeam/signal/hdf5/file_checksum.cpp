#include "shelfbeam/signal/hdf5/file_checksum.hpp"

#include <cerrno>
#include <fstream>
#include <string_view>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::string_view title = "shelfbeam signal file, XXH3-128 of what follows this line: ";
constexpr std::size_t line_length = title.size() + 32 + 1;
static_assert(line_length <= checksum_block);

// The line for the bytes after it.
std::string line_of(std::istream& file) {
  file.seekg(line_length);
  return std::string(title) + content_hash(file) + "\n";
}

}  // namespace

bool has_file_checksum(const std::filesystem::path& path) {
  return read_first_bytes(path, title.size()) == title;
}

void write_file_checksum(const std::filesystem::path& path, const std::string& name) {
  errno = 0;
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  const std::string line = line_of(file);
  if (!file.bad()) file.clear();  // clears end-of-file
  file.seekp(0);
  file << line << std::flush;
  if (!file) cannot_write(name, system_reason());
}

void verify_file_checksum(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (read_first_bytes(path, line_length) != line_of(file))
    throw InputError(path.string(), "is corrupt or was changed: its checksum does not match",
                     "simulate it again, or remove its first 512 bytes if the change was intended");
}

}  // namespace shelfbeam::detail
