#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/tables/csv_readings.hpp"
#include "shelfbeam/signal/tables/formats.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam::detail {

namespace {

void read_row(SignalTable& table, CsvReader& csv, std::size_t first_value) {
  const std::size_t expected = first_value + table.columns();
  csv.expect_fields(expected, expected, ", one value for each transceiver");
  for (std::size_t j = 0; j < table.columns(); ++j)
    if (const double value = csv.amount(first_value + j); value > 0)
      table.entries.push_back({static_cast<std::uint32_t>(j), value});
  table.row_begin.push_back(table.entries.size());
}

/// The fields of the record without empty fields at its end.
std::vector<std::string> filled_fields(const CsvReader& csv) {
  std::size_t count = csv.fields().size();
  while (count > 0 && csv.fields()[count - 1].empty()) --count;
  return {csv.fields().begin(), csv.fields().begin() + static_cast<std::ptrdiff_t>(count)};
}

/// Returns the first column.
std::vector<std::string> read_plain_rows(SignalTable& table, CsvReader& csv) {
  std::vector<std::string> column;
  do {
    column.emplace_back(csv.fields()[0]);
    read_row(table, csv, 0);
  } while (csv.next());
  number_labels(table, table.row_begin.size() - 1);
  return column;
}

void read_labelled_rows(SignalTable& table, CsvReader& csv) {
  do {
    table.labels.push_back({.id = csv.id(0)});
    read_row(table, csv, 1);
  } while (csv.next());
}

struct Header {
  std::vector<std::string> fields;
  bool has_corner;  ///< a field above the ids of labels, if the rows have these
};

/// Reads a header, without fields at its end that are empty there and in the first row. Moves to this row.
Header read_header(CsvReader& csv) {
  std::vector<std::string> fields;
  for (std::size_t j = 0; j < csv.fields().size(); ++j)
    fields.push_back(j == 0 || csv.fields()[j].empty() ? csv.text(j) : csv.id(j));
  if (!csv.next()) csv.fail("is a header without rows", "add a row for every label");
  std::size_t row = csv.fields().size();
  for (const std::size_t filled = filled_fields(csv).size(); row > filled && fields.back().empty(); --row)
    fields.pop_back();
  const bool has_corner = row != fields.size() + 1;
  return {std::move(fields), has_corner};
}

void add_transceivers(SignalTable& table, const CsvReader& csv, const std::vector<std::string>& header,
                      std::size_t first) {
  for (std::size_t j = first; j < header.size(); ++j) {
    if (header[j].empty())
      csv.fail(fmt::format("the header's field {} is empty", j + 1), "give every transceiver an id");
    if (const std::string character = unprintable_character(header[j]); !character.empty())
      csv.fail(fmt::format("the header's field {} has the unprintable character '{}'", j + 1, character),
               "remove it from the id");
    table.transceivers.push_back({.id = header[j]});
  }
  if (table.transceivers.empty()) csv.fail("the header has no transceivers", "add a column for each");
}

/// Returns the title of the ids of labels; empty if there is none.
std::string read_rows_with_ids(SignalTable& table, CsvReader& csv) {
  Header header = read_header(csv);
  add_transceivers(table, csv, header.fields, header.has_corner ? 1 : 0);
  read_labelled_rows(table, csv);
  return header.has_corner ? std::move(header.fields[0]) : "";
}

// Whether this separator splits the first two records into a header and a row, or into rows, of a matrix.
bool separates(std::string_view text, const std::string& name, char separator) {
  CsvReader csv(text, name, separator);
  if (!csv.next()) return false;
  const auto has_numbers_from = [&](std::size_t first) {
    for (std::size_t j = first; j < csv.fields().size(); ++j)
      if (!csv.is_number(j)) return false;
    return csv.fields().size() > first;
  };
  if (csv.is_number(0)) return has_numbers_from(0);
  const std::size_t header = csv.fields().size();
  return csv.next() && (csv.fields().size() == header || csv.fields().size() == header + 1) &&
         has_numbers_from(1);
}

// Whether the first record names transceivers by numbers, and has no field above the ids of labels.
bool lacks_corner(std::string_view text, const std::string& name, std::optional<char> separator) {
  CsvReader csv(text, name, separator);
  if (!csv.next()) return false;
  const std::size_t header = csv.fields().size();
  return csv.next() && csv.fields().size() == header + 1 && !csv.is_number(0) && csv.is_number(1);
}

// The ids in a header may contain further separators.
std::optional<char> separator_of(std::string_view text, const std::string& name) {
  const std::string separators = csv_separators(text);
  if (separators.size() < 2) return std::nullopt;
  std::string fitting;
  for (const char separator : separators)
    if (separates(text, name, separator)) fitting += separator;
  if (fitting.size() > 1)
    throw InputError(name + ": line 1", "may be separated by more than one of comma, semicolon and tab",
                     "put the ids in quotes, or begin the file with a line like 'sep=;'");
  // If the first rows are wrong, reports the error with the old separator.
  if (!fitting.empty()) return fitting.front();
  return separators.find(',') != std::string::npos ? ',' : separators.front();
}

// Calls apply(row, field) for every line after the header, with the element of `rows` that has its id. Lines
// with the id of an excluded element have no effect.
template <class Rows, class Apply>
void for_each_line(CsvReader& csv, Rows& rows, std::string_view kind, const Apply& apply,
                   std::span<const std::string> excluded = {}) {
  const std::size_t width = csv.fields().size();
  const CsvIdLookup ids(rows, kind, excluded);
  std::unordered_set<std::uint32_t> seen;
  while (csv.next()) {
    csv.expect_fields(width, width);
    if (ids.is_ignored(csv, 0)) continue;
    const std::uint32_t row = ids.read(csv, 0);
    if (!seen.insert(row).second)
      csv.fail(0, fmt::format("is the duplicate {} {}", kind, in_quotes(csv.id(0))),
               "remove one of the lines");
    for (std::size_t field = 1; field < width; ++field) apply(rows[row], field);
  }
}

}  // namespace

ReadTable read_csv_table(std::string_view text, const std::string& name, TableReading reading) {
  text = without_mark(text, name, save_table_as_utf8);
  const std::optional<char> separator = separator_of(text, name);
  CsvReader csv(text, name, separator);
  SignalTable table;
  table.row_begin = {0};
  if (!csv.next()) csv.fail("is empty", "name a file with a signal matrix");
  if (csv.fields()[0].starts_with('#'))
    csv.fail("is a comment; a matrix file cannot contain comments", "remove the line");
  const auto refuse = [&](const std::string& problem, const std::string& choice) {
    throw InputError(name, problem, choice, Setting::reading);
  };
  const bool is_chosen = reading != TableReading::automatic;
  // The first field of a header is not a number: it is an id or the title of the ids.
  if (!is_chosen)
    reading =
        csv.is_number(0) && !lacks_corner(text, name, separator) ? TableReading::signals : TableReading::ids;
  const std::vector<std::string> first = filled_fields(csv);
  if (reading == TableReading::signals) {
    number_transceivers(table, first.size());
    const std::vector<std::string> column = read_plain_rows(table, csv);
    if (!is_chosen && table.rows() > 1 && may_be_header(first, table))
      refuse("has whole numbers in its first row, which may be ids or signals",
             "choose 'header' for ids of transceivers, 'ids' if the first column also has ids of labels, "
             "or 'signals'");
    if (!is_chosen && may_be_labels(column, table))
      refuse("has whole numbers in its first column, which may be ids or signals",
             "choose 'labels' for ids of labels, or 'signals'");
  } else if (reading == TableReading::labels) {
    if (first.size() < 2) csv.fail("has one field", "an id and at least one signal are expected");
    number_transceivers(table, first.size() - 1);
    read_labelled_rows(table, csv);
  } else if (reading == TableReading::header) {
    add_transceivers(table, csv, read_header(csv).fields, 0);
    read_plain_rows(table, csv);
  } else {
    const std::string title = read_rows_with_ids(table, csv);
    if (!is_chosen && may_be_signals(title, table))
      refuse(fmt::format("has numbers in its first column {}, which may be ids or signals", in_quotes(title)),
             "choose 'ids' for ids of labels, or 'header' for signals");
  }
  ReadTable result{std::move(table)};
  if (auto warning = csv.warning_of_ids()) result.warnings.push_back(std::move(*warning));
  return result;
}

}  // namespace shelfbeam::detail

namespace shelfbeam {

void apply_costs(SignalTable& table, const std::filesystem::path& path) {
  const std::string text = detail::read_text_file(path);
  CsvReader csv(text, path.string());
  if (!csv.next()) csv.fail("is empty", "the first line must be 'id,cost' or 'id,link_cost,signal_cost'");

  const std::vector<std::string> header = csv.column_names();
  constexpr std::array<std::string_view, 3> costs = {"cost", "link_cost", "signal_cost"};
  for (std::size_t i = 0; i < header.size(); ++i) {
    const bool known =
        i == 0 ? header[i] == "id" : std::find(costs.begin(), costs.end(), header[i]) != costs.end();
    if (!known)
      csv.fail(i, fmt::format("is the unknown column {}", in_quotes(csv.fields()[i])),
               "the first line must be 'id,cost' or 'id,link_cost,signal_cost'");
    if (std::find(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(i), header[i]) !=
        header.begin() + static_cast<std::ptrdiff_t>(i))
      csv.fail(i, fmt::format("is the duplicate column {}", in_quotes(header[i])), "remove one of them");
  }
  const bool of_transceivers = std::find(header.begin(), header.end(), "cost") != header.end();
  if (header.size() < 2 || (of_transceivers && header.size() > 2))
    csv.fail("is the header of neither transceiver costs nor label costs",
             "the first line must be 'id,cost' or 'id,link_cost,signal_cost'");

  if (of_transceivers) {
    detail::for_each_line(
        csv, table.transceivers, "transceiver",
        [&](SignalTable::Transceiver& unit, std::size_t field) { unit.cost = csv.amount(field); },
        table.excluded);
  } else {
    detail::for_each_line(csv, table.labels, "label", [&](SignalTable::Label& label, std::size_t field) {
      (header[field] == "link_cost" ? label.link_cost : label.signal_cost) = csv.amount(field);
    });
  }
}

namespace {

/// An id of the file, and the rows that it stands for.
struct NamedRows {
  std::string id;
  std::vector<LabelId> rows;
};

/// Every label by its id, and by its id in its scenario, which may stand for a row in each.
std::vector<NamedRows> named_rows(const SignalTable& table) {
  std::vector<NamedRows> result;
  for (std::uint32_t i = 0; i < table.rows(); ++i) result.push_back({table.labels[i].id, {i}});
  std::unordered_map<std::string, std::size_t> known;
  for (const SignalTable::Scenario& scenario : table.scenarios)
    for (std::size_t i = scenario.first; i < scenario.first + scenario.labels; ++i) {
      std::string id = table.labels[i].id.substr(scenario.name.size() + 1);
      const auto [found, is_new] = known.emplace(id, result.size());
      if (is_new) result.push_back({std::move(id), {}});
      result[found->second].rows.push_back(static_cast<std::uint32_t>(i));
    }
  return result;
}

}  // namespace

void apply_weights(SignalTable& table, const std::filesystem::path& path) {
  const char* const expected = "the first line must be 'id,weight'";
  const std::string text = detail::read_text_file(path);
  CsvReader csv(text, path.string());
  if (!csv.next()) csv.fail("is empty", expected);
  if (csv.column_names() != std::vector<std::string>{"id", "weight"})
    csv.fail("is not the header of a file of weights", expected);
  std::vector<NamedRows> named = named_rows(table);
  std::vector<bool> seen(table.rows(), false);
  detail::for_each_line(csv, named, "label", [&](const NamedRows& label, std::size_t field) {
    const double weight = csv.amount(field);
    for (const LabelId i : label.rows) {
      if (seen[i])
        csv.fail(0, fmt::format("is a second weight of label {}", in_quotes(table.labels[i].id)),
                 "remove one of the lines");
      seen[i] = true;
      table.labels[i].weight = weight;
    }
  });
}

}  // namespace shelfbeam
