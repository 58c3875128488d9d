#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/number.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/formats.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {

namespace {

// The first line tells the formats apart: "m n g" is sparse text, "m n" OR-Library, and all else is CSV,
// which has commas unless there is a single column.
SignalTable read_text_table(std::string_view text, const std::string& name) {
  const std::string_view content = trim(text);
  if (content.empty()) throw InputError(name, "is empty", "name a file with a signal matrix");
  const std::string_view first_line = trim(content.substr(0, content.find('\n')));
  if (first_line.find(',') != std::string_view::npos) return detail::read_csv_table(text, name);

  std::size_t words = 0, numbers = 0;
  for (const std::string_view word : split(first_line, ' ')) {
    for (const std::string_view part : split(word, '\t')) {
      words += part.empty() ? 0 : 1;
      numbers += to_number(part) ? 1 : 0;
    }
  }
  if (numbers == words) {
    if (words == 1) return detail::read_csv_table(text, name);
    if (words == 2) return detail::read_or_library(text, name);
    if (words == 3) return detail::read_sparse_text(text, name);
  }
  throw InputError(name + ": line 1",
                   fmt::format("'{}' begins no known matrix format", first_line.substr(0, 60)),
                   "CSV (separated by commas), sparse text ('m n g') and OR-Library ('m n') are understood");
}

}  // namespace

SignalTable read_signal_table(const std::filesystem::path& path) {
  SignalTable table;
  if (is_hdf5(path))
    table = make_signal_table(read_signal_file(path), path.string());
  else if (detail::read_first_bytes(path, 6) == "\x93NUMPY")
    table = detail::read_npy_table(path);
  else
    table = read_text_table(detail::read_text_file(path), path.string());
  detail::check_unique_ids(table, path.string());
  return table;
}

}  // namespace shelfbeam
