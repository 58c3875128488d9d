#include <bit>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/tables/formats.hpp"
#include "shelfbeam/signal/tables/npy_header.hpp"
#include "shelfbeam/signal/text_file.hpp"

static_assert(std::endian::native == std::endian::little, "NPY files are read in memory byte order");

namespace shelfbeam::detail {
namespace fs = std::filesystem;

namespace {

struct Npy {
  NpyHeader header;
  std::size_t data_begin;  ///< bytes from the beginning of the file
};

Npy read_header(const fs::path& path) {
  constexpr std::size_t longest = 1 << 16;
  const std::string bytes = read_first_bytes(path, longest);
  const auto byte = [&](std::size_t i) -> std::size_t {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
  };
  const std::size_t prefix = byte(6) == 1 ? 10 : 12;
  std::size_t length = byte(8) | byte(9) << 8;
  if (prefix == 12) length |= byte(10) << 16 | byte(11) << 24;
  if (byte(6) < 1 || byte(6) > 3 || bytes.size() < prefix || length > bytes.size() - prefix)
    throw InputError(path.string() + ": header", "is truncated, corrupt or of an unknown NPY version",
                     "write the file again with numpy.save");
  return {parse_npy_header(std::string_view(bytes).substr(prefix, length), path.string()), prefix + length};
}

template <class T>
SignalTable read_entries(const fs::path& path, const Npy& npy) {
  const auto& [header, data_begin] = npy;
  const std::size_t m = header.rows, n = header.columns;
  // The table takes at least as much memory as the file.
  const std::size_t present = input_size(path, memory_limit() / 2) - data_begin;
  if (present % sizeof(T) != 0 || present / sizeof(T) / n != m || present / sizeof(T) % n != 0)
    throw InputError(path.string(),
                     fmt::format("has {} bytes of data, but its shape ({}, {}) requires {}", present, m, n,
                                 static_cast<double>(m) * static_cast<double>(n) * sizeof(T)),
                     "it is truncated or corrupt: write it again");
  std::vector<T> values(m * n);
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(data_begin));
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  if (!in) throw InputError(path.string(), "cannot be read to its end", "check the disk");

  SignalTable table;
  number_labels(table, m);
  number_transceivers(table, n);
  table.row_begin = {0};
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double value = values[header.columns_first ? j * m + i : i * n + j];
      if (const auto problem = amount_problem(value); !problem.empty())
        throw InputError(fmt::format("{}: row {}, column {}", path.string(), i + 1, j + 1),
                         std::string(problem), "a finite number that is not negative is expected");
      if (value > 0) table.entries.push_back({static_cast<std::uint32_t>(j), value});
    }
    table.row_begin.push_back(table.entries.size());
  }
  return table;
}

}  // namespace

SignalTable read_npy_table(const fs::path& path) {
  const Npy npy = read_header(path);
  return npy.header.is_double ? read_entries<double>(path, npy) : read_entries<float>(path, npy);
}

}  // namespace shelfbeam::detail
