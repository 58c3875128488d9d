#include "shelfbeam/signal/tables/signal_table.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/formats.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {

namespace {

void expect_one_installed(const SignalTable& table, const std::string& name) {
  for (const auto& mount : table.mounts) {
    const SignalTable::Transceiver* installed = nullptr;
    for (const std::uint32_t j : mount) {
      const SignalTable::Transceiver& unit = table.transceivers[j];
      if (!unit.installed) continue;
      if (installed != nullptr)
        throw InputError(name + ": /transceivers/installed",
                         fmt::format("{} and {} are installed at the same mounting point",
                                     in_quotes(installed->id), in_quotes(unit.id)),
                         "keep one of them in the store, and simulate it again");
      installed = &unit;
    }
  }
}

template <class Rows>
void check_unique(const Rows& rows, std::string_view kind, const std::string& name) {
  std::unordered_set<std::string_view> seen;
  seen.reserve(rows.size());
  for (const auto& row : rows)
    if (!seen.insert(row.id).second)
      throw InputError(name, fmt::format("has the duplicate {} id {}", kind, in_quotes(row.id)),
                       id_remedy(row.id, "make ids unique"));
}

// A table, or the error of its reader.
struct Attempt {
  std::optional<ReadTable> table = {};
  std::optional<InputError> error = {};

  bool fits() const { return table || error->setting() == Setting::reading; }
};

template <class Read>
Attempt attempt(const Read& read) {
  try {
    return {read()};
  } catch (const InputError& error) {
    return {{}, error};
  }
}

// Reads a text that begins with a line of two or three numbers: OR-Library or sparse text, but with tabs
// between the numbers perhaps CSV.
ReadTable read_numbers(std::string_view text, const std::string& name,
                       const std::vector<std::string_view>& words, bool has_tabs) {
  const bool is_sparse = words.size() == 3;
  const auto read_form = [&] {
    return ReadTable{is_sparse ? detail::read_sparse_text(text, name) : detail::read_or_library(text, name)};
  };
  if (!has_tabs) return read_form();
  constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
  if (!to_whole_number(words[0], any) || !to_whole_number(words[1], any))
    return detail::read_csv_table(text, name);
  Attempt form = attempt(read_form), csv = attempt([&] { return detail::read_csv_table(text, name); });
  if (form.fits() && csv.fits())
    throw InputError(
        name, fmt::format("may be a matrix in CSV or {}", is_sparse ? "sparse text" : "an OR-Library file"),
        is_sparse ? "choose 'signals' or 'sparse'" : "choose 'signals', 'scp' or 'rail'", Setting::reading);
  if (form.table) return std::move(*form.table);
  if (csv.table) return std::move(*csv.table);
  throw csv.fits() ? *csv.error : *form.error;
}

// Without a given reading, the first line determines the format: "m n g" is sparse text, "m n" is OR-Library,
// and anything else is CSV, which has separators unless it has a single column.
ReadTable read_text_table(std::string_view text, const std::string& name, TableReading reading) {
  const std::string_view content = trim(text);
  if (content.empty()) throw InputError(name, "is empty", "name a file with a signal matrix");
  if (reading == TableReading::scp || reading == TableReading::rail)
    return {detail::read_or_library(text, name, reading)};
  if (reading == TableReading::sparse) return {detail::read_sparse_text(text, name)};
  if (reading != TableReading::automatic) return detail::read_csv_table(text, name, reading);
  const std::string_view first_line = trim(content.substr(0, content.find_first_of("\r\n")));
  if (first_line.find_first_of(",;") != std::string_view::npos) return detail::read_csv_table(text, name);

  std::vector<std::string_view> words;
  for (const std::string_view word : split(first_line, ' '))
    for (const std::string_view part : split(word, '\t'))
      if (!part.empty()) words.push_back(part);
  const bool are_numbers =
      std::all_of(words.begin(), words.end(), [](std::string_view word) { return to_number(word); });
  const bool has_tabs = csv_separators(first_line) == "\t";
  if (are_numbers && (words.size() == 2 || words.size() == 3))
    return read_numbers(text, name, words, has_tabs);
  if ((are_numbers && words.size() == 1) || has_tabs) return detail::read_csv_table(text, name);
  throw InputError(name + ": line 1",
                   fmt::format("{} does not begin a known matrix format", in_quotes(first_line)),
                   "CSV (separated by commas, semicolons or tabs), sparse text ('m n g') and OR-Library ('m "
                   "n') are supported");
}

}  // namespace

std::vector<std::vector<ColumnId>> shared_mounts(const SignalMatrix& matrix) {
  const DistinctPositions groups = distinct_positions(positions_of(matrix.transceivers));
  std::vector<std::vector<ColumnId>> mounts(groups.count);
  for (std::uint32_t j = 0; j < matrix.columns(); ++j) mounts[groups.group_of[j]].push_back(j);
  std::erase_if(mounts, [](const auto& mount) { return mount.size() < 2; });
  return mounts;
}

SignalTable make_signal_table(const SignalMatrix& matrix, const std::string& name) {
  SignalTable table;
  table.labels.reserve(matrix.rows());
  for (const LabelRow& label : matrix.labels)
    table.labels.push_back(
        {label.id, label.requirement, label.requirement, label.link_cost, label.signal_cost});
  table.transceivers.reserve(matrix.columns());
  for (const TransceiverColumn& unit : matrix.transceivers)
    table.transceivers.push_back(
        {unit.id, unit.cost, unit.installed || unit.pinned, unit.position, unit.pinned});
  table.excluded = matrix.excluded;
  table.currency = matrix.currency;
  table.mounts = shared_mounts(matrix);
  expect_one_installed(table, name);

  const auto is_entry = [](float value) { return value > 0; };
  table.entries.reserve(
      static_cast<std::size_t>(std::count_if(matrix.mean.begin(), matrix.mean.end(), is_entry)));
  table.row_begin = {0};
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const std::span<const float> row = matrix.mean_row(i);
    for (std::size_t j = 0; j < row.size(); ++j)
      if (is_entry(row[j])) table.entries.push_back({static_cast<std::uint32_t>(j), row[j]});
    table.row_begin.push_back(table.entries.size());
  }
  return table;
}

void set_requirement(SignalTable& table, double requirement) {
  for (SignalTable::Label& label : table.labels) label.requirement = label.single_requirement = requirement;
}

namespace detail {

void number_labels(SignalTable& table, std::size_t count) {
  table.labels.resize(count);
  for (std::size_t i = 0; i < count; ++i) table.labels[i].id = fmt::format("L{}", i + 1);
}

void number_transceivers(SignalTable& table, std::size_t count) {
  table.transceivers.resize(count);
  for (std::size_t j = 0; j < count; ++j) table.transceivers[j].id = fmt::format("T{}", j + 1);
}

void check_unique_ids(const SignalTable& table, const std::string& name) {
  check_unique(table.labels, "label", name);
  check_unique(table.transceivers, "transceiver", name);
}

}  // namespace detail

SignalTable read_signal_table(const std::filesystem::path& path) {
  return read_table(path, TableReading::automatic).table;
}

ReadTable read_table(const std::filesystem::path& path, TableReading reading) {
  ReadTable result;
  const bool is_signal_file = is_hdf5(path),
             is_npy = !is_signal_file && detail::read_first_bytes(path, 6) == "\x93NUMPY";
  if (reading != TableReading::automatic && (is_signal_file || is_npy))
    throw InputError(path.string(),
                     fmt::format("is {}, which cannot be read as '{}'",
                                 is_npy ? "an NPY file" : "a signal file", to_text(reading)),
                     "choose a reading only for CSV, sparse text and OR-Library files", Setting::reading);
  if (is_signal_file)
    result.table = make_signal_table(read_signal_file(path), path.string());
  else if (is_npy)
    result.table = detail::read_npy_table(path);
  else
    result = read_text_table(detail::read_text_file(path), path.string(), reading);
  detail::check_unique_ids(result.table, path.string());
  return result;
}

}  // namespace shelfbeam
