#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/tables/formats.hpp"
#include "shelfbeam/signal/text_file.hpp"

static_assert(std::endian::native == std::endian::little, "NPY files are read in memory byte order");

namespace shelfbeam::detail {
namespace fs = std::filesystem;

namespace {

struct NpyHeader {
  bool is_double = false;
  bool columns_first = false;
  std::size_t rows = 0, columns = 0;
  std::size_t data_begin = 0;  ///< bytes from the beginning of the file
};

NpyHeader parse_header(std::string_view text, const std::string& name) {
  const auto wrong = [&](const std::string& problem, const std::string& suggestion) {
    return InputError(name + ": header", problem, suggestion);
  };
  // The text after 'key': up to and including `end`.
  const auto value = [&](std::string_view key, std::string_view end) {
    const std::string quoted = fmt::format("'{}':", key);
    if (const auto found = text.find(quoted); found != std::string_view::npos) {
      const std::string_view rest = text.substr(found + quoted.size());
      if (const auto stop = rest.find_first_of(end); stop != std::string_view::npos)
        return trim(rest.substr(0, stop + 1));
    }
    throw wrong(fmt::format("is missing '{}'", key), "write the file again with numpy.save");
  };
  NpyHeader header;
  const std::string_view type = value("descr", ",");
  if (type == "'<f8',")
    header.is_double = true;
  else if (type != "'<f4',")
    throw wrong(fmt::format("the data have type {}", type.substr(0, type.size() - 1)),
                type.starts_with("'>") ? "big-endian is not supported: save matrix.astype('<f4')"
                                       : "'<f4' and '<f8' are supported: save matrix.astype('<f4')");

  const std::string_view order = value("fortran_order", ",");
  if (order != "True," && order != "False,")
    throw wrong("'fortran_order' is neither True nor False", "write it again");
  header.columns_first = order == "True,";

  const std::string_view shape = value("shape", ")");
  std::vector<std::size_t> extents;
  for (std::string_view part :
       split(shape.substr(std::min<std::size_t>(1, shape.size()), shape.size() - 2), ',')) {
    std::size_t extent = 0;
    const auto [stopped, error] = std::from_chars(part.data(), part.data() + part.size(), extent);
    if (!part.empty() && error == std::errc{} && stopped == part.data() + part.size())
      extents.push_back(extent);
  }
  constexpr std::size_t max_extent = std::numeric_limits<std::uint32_t>::max() - 1;
  if (extents.size() != 2 || extents[0] == 0 || extents[1] == 0 || extents[0] > max_extent ||
      extents[1] > max_extent)
    throw wrong(fmt::format("the shape is {}", shape), "a matrix (labels, transceivers) is expected");
  header.rows = extents[0];
  header.columns = extents[1];
  return header;
}

NpyHeader read_header(const fs::path& path) {
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
  NpyHeader header = parse_header(std::string_view(bytes).substr(prefix, length), path.string());
  header.data_begin = prefix + length;
  return header;
}

template <class T>
SignalTable read_entries(const fs::path& path, const NpyHeader& header) {
  const std::size_t m = header.rows, n = header.columns;
  // The table takes at least as much memory as the file.
  const std::size_t present = input_size(path, memory_limit() / 2) - header.data_begin;
  if (present % sizeof(T) != 0 || present / sizeof(T) / n != m || present / sizeof(T) % n != 0)
    throw InputError(path.string(),
                     fmt::format("has {} bytes of data, but its shape ({}, {}) requires {}", present, m, n,
                                 static_cast<double>(m) * static_cast<double>(n) * sizeof(T)),
                     "it is truncated or corrupt: write it again");
  std::vector<T> values(m * n);
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(header.data_begin));
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
  const NpyHeader header = read_header(path);
  return header.is_double ? read_entries<double>(path, header) : read_entries<float>(path, header);
}

}  // namespace shelfbeam::detail
