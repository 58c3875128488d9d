#include "shelfbeam/signal/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <memory>
#include <system_error>

#include <fmt/format.h>
#include <zlib.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::detail {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t piece = 1 << 16;

[[noreturn]] void cannot_read(const fs::path& path) {
  throw InputError(path.string(), fmt::format("cannot be read ({})", system_reason()), "check the path");
}

void check_is_text(const fs::path& path, std::string_view text) {
  const auto is_binary = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f';
  };
  const std::string_view head = without_mark(text, path.string(), save_table_as_utf8).substr(0, 4096);
  if (std::any_of(head.begin(), head.end(), is_binary))
    throw InputError(path.string(), "is neither a signal file (HDF5), nor NPY, nor text",
                     "check that it is complete and the right file (gzip is supported for text only)");
}

}  // namespace

std::string read_first_bytes(const fs::path& path, std::size_t count) {
  input_size(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) cannot_read(path);
  std::string bytes(count, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  if (in.bad()) cannot_read(path);
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

std::string read_text_file(const fs::path& path, std::size_t max_bytes) {
  const std::uint64_t packed = input_size(path, max_bytes);
  // A small file that unpacks without end is refused within a second or so.
  constexpr std::uint64_t always_allowed = std::uint64_t{1} << 28, usual_ratio = 100;
  const std::uint64_t limit =
      std::min<std::uint64_t>(max_bytes, std::max(always_allowed, usual_ratio * packed));
  errno = 0;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose_r);
  if (!file) cannot_read(path);
  gzbuffer(file.get(), piece);

  std::string text;
  std::size_t size = 0;
  while (true) {
    text.resize(size + std::clamp(size, piece, 64 * piece));
    const int got = gzread(file.get(), text.data() + size, static_cast<unsigned>(text.size() - size));
    int state = Z_OK;
    const std::string message = gzerror(file.get(), &state);
    if (state == Z_ERRNO) cannot_read(path);
    if (got < 0 || state == Z_BUF_ERROR)
      throw InputError(path.string(), fmt::format("is a truncated or corrupt gzip file ({})", message),
                       "download or compress it again");
    if (got == 0) break;
    if (size == 0) check_is_text(path, std::string_view(text).substr(0, static_cast<std::size_t>(got)));
    size += static_cast<std::size_t>(got);
    if (size > limit)
      throw InputError(
          path.string(), fmt::format("has more than {} bytes of decompressed text", grouped(limit)),
          limit == max_bytes
              ? "check that it is the right file; a signal file (HDF5) or NPY requires less memory"
              : "check that it is the right file, or decompress it first");
  }
  text.resize(size);
  check_is_text(path, text);
  text.erase(0, text.size() - without_mark(text, path.string()).size());
  return text;
}

}  // namespace shelfbeam::detail
