#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/signal/tables/formats.hpp"
#include "shelfbeam/signal/tables/text_scanner.hpp"

namespace shelfbeam::detail {

namespace {

struct Extent {
  std::uint32_t rows, columns;
};

Extent read_extent(TextScanner& in) {
  in.at_end();
  const std::uint32_t rows = in.extent("the number of rows m");
  const std::uint32_t columns = in.extent("the number of columns n");
  in.end_line("'m n'");
  return {rows, columns};
}

SignalTable covering_table(Extent extent, const std::vector<double>& costs) {
  SignalTable table;
  number_labels(table, extent.rows);
  for (SignalTable::Label& label : table.labels) label.requirement = label.single_requirement = 1;
  number_transceivers(table, extent.columns);
  for (std::size_t j = 0; j < costs.size(); ++j) table.transceivers[j].cost = costs[j];
  return table;
}

// Row-wise: the costs of all columns, then for each row a count and the columns that cover it (from 1).
SignalTable read_scp(TextScanner& in) {
  const Extent extent = read_extent(in);
  std::vector<double> costs;
  for (std::uint32_t j = 0; j < extent.columns; ++j) costs.push_back(in.amount("the cost of a column"));

  std::vector<SignalEntry> entries;
  std::vector<std::size_t> row_begin = {0};
  for (std::uint32_t i = 0; i < extent.rows; ++i) {
    const std::uint32_t count = in.integer("the number of columns of a row", 0, extent.columns);
    for (std::uint32_t k = 0; k < count; ++k)
      entries.push_back({in.integer("a column number", 1, extent.columns) - 1, 1});
    const auto first = entries.begin() + static_cast<std::ptrdiff_t>(row_begin.back());
    std::sort(first, entries.end(),
              [](const auto& a, const auto& b) { return a.transceiver < b.transceiver; });
    row_begin.push_back(entries.size());
  }
  if (!in.at_end()) in.fail("the file continues after the last row", "remove the rest or correct the counts");

  SignalTable table = covering_table(extent, costs);
  table.entries = std::move(entries);
  table.row_begin = std::move(row_begin);
  return table;
}

// Column-wise: a line per column with its cost, a count and the rows that it covers (from 1).
SignalTable read_rail(TextScanner& in) {
  const Extent extent = read_extent(in);
  std::vector<double> costs;
  std::vector<std::uint32_t> covered;  // rows from 0, column after column
  std::vector<std::size_t> column_begin = {0};
  for (std::uint32_t j = 0; j < extent.columns; ++j) {
    if (in.at_end())
      in.fail(fmt::format("the file ends after {} of {} columns", j, extent.columns),
              "download it again or correct n");
    costs.push_back(in.amount("the cost of a column"));
    const std::uint32_t count = in.integer("the number of rows of a column", 0, extent.rows);
    for (std::uint32_t k = 0; k < count; ++k)
      covered.push_back(in.integer("a row number", 1, extent.rows) - 1);
    in.end_line(fmt::format("{} row numbers", count));
    column_begin.push_back(covered.size());
  }
  if (!in.at_end())
    in.fail(fmt::format("the file continues after column {}", extent.columns),
            "remove the rest or correct n");

  SignalTable table = covering_table(extent, costs);
  table.row_begin.assign(extent.rows + std::size_t{1}, 0);
  for (const std::uint32_t row : covered) ++table.row_begin[row + std::size_t{1}];
  for (std::size_t i = 0; i < extent.rows; ++i) table.row_begin[i + 1] += table.row_begin[i];
  table.entries.resize(covered.size());
  std::vector<std::size_t> next(table.row_begin.begin(), table.row_begin.end() - 1);
  for (std::uint32_t j = 0; j < extent.columns; ++j)
    for (std::size_t k = column_begin[j]; k < column_begin[j + 1]; ++k)
      table.entries[next[covered[k]]++] = {j, 1};
  return table;
}

void check_no_repeats(const SignalTable& table, const std::string& name) {
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (std::size_t k = 1; k < table.row(i).size(); ++k)
      if (table.row(i)[k].transceiver == table.row(i)[k - 1].transceiver)
        throw InputError(name,
                         fmt::format("column {} covers row {} twice", table.row(i)[k].transceiver + 1, i + 1),
                         "remove one of the two numbers");
}

bool are_equal(const SignalTable& a, const SignalTable& b) {
  const auto same_cost = [](const auto& x, const auto& y) { return x.cost == y.cost; };
  const auto same_column = [](const SignalEntry& x, const SignalEntry& y) {
    return x.transceiver == y.transceiver;
  };
  return a.row_begin == b.row_begin &&
         std::equal(a.transceivers.begin(), a.transceivers.end(), b.transceivers.begin(),
                    b.transceivers.end(), same_cost) &&
         std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(), same_column);
}

/// The table of one form, or the error and the place that the reader reached.
struct Attempt {
  std::optional<SignalTable> table;
  std::exception_ptr error;
  std::size_t position = 0;
};

Attempt attempt(bool is_wanted, SignalTable (*read)(TextScanner&), TextScanner in, const std::string& name) {
  Attempt result;
  if (!is_wanted) return result;
  try {
    SignalTable table = read(in);
    check_no_repeats(table, name);
    result.table = std::move(table);
  } catch (const InputError&) {
    result.error = std::current_exception();
  }
  result.position = in.position();
  return result;
}

}  // namespace

SignalTable read_or_library(std::string_view text, const std::string& name, TableReading reading) {
  // The file does not state its form. If neither fits, the error of the reader that got further is reported.
  const Attempt rail = attempt(reading != TableReading::scp, read_rail,
                               TextScanner(text, name, LineBreaks::matter), name),
                scp = attempt(reading != TableReading::rail, read_scp,
                              TextScanner(text, name, LineBreaks::blank), name);
  if (rail.table && scp.table && !are_equal(*rail.table, *scp.table))
    throw InputError(name, "fits both forms of OR-Library files, which describe different matrices",
                     "choose 'scp' or 'rail'", Setting::reading);
  if (rail.table) return *rail.table;
  if (scp.table) return *scp.table;
  std::rethrow_exception(rail.position >= scp.position ? rail.error : scp.error);
}

}  // namespace shelfbeam::detail
