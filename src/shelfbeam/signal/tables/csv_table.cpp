#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/number.hpp"
#include "shelfbeam/signal/tables/formats.hpp"

namespace shelfbeam::detail {

namespace {

void read_row(SignalTable& table, const CsvReader& csv, std::size_t first_value) {
  const std::size_t expected = first_value + table.columns();
  if (csv.fields().size() != expected)
    csv.fail(fmt::format("has {} fields where {} are expected", csv.fields().size(), expected),
             "give every row one value for each transceiver");
  for (std::size_t j = 0; j < table.columns(); ++j)
    if (const double value = csv.amount(first_value + j); value > 0)
      table.entries.push_back({static_cast<std::uint32_t>(j), value});
  table.row_begin.push_back(table.entries.size());
}

void read_plain_rows(SignalTable& table, CsvReader& csv) {
  number_transceivers(table, csv.fields().size());
  do {
    read_row(table, csv, 0);
  } while (csv.next());
  number_labels(table, table.row_begin.size() - 1);
}

void read_rows_with_ids(SignalTable& table, CsvReader& csv) {
  const std::vector<std::string> header(csv.fields().begin(), csv.fields().end());
  if (!csv.next()) csv.fail("is a header without rows", "add a row for every label");
  // The header may or may not have a field above the ids of the labels.
  const std::size_t corner = csv.fields().size() == header.size() + 1 ? 0 : 1;
  for (std::size_t j = corner; j < header.size(); ++j) {
    if (header[j].empty())
      csv.fail(fmt::format("the header's field {} is empty", j + 1), "give every transceiver an id");
    table.transceivers.push_back({.id = header[j]});
  }
  if (table.transceivers.empty()) csv.fail("the header names no transceiver", "add a column for each");
  do {
    table.labels.push_back({.id = csv.id(0)});
    read_row(table, csv, 1);
  } while (csv.next());
}

}  // namespace

SignalTable read_csv_table(std::string_view text, const std::string& name) {
  CsvReader csv(text, name);
  SignalTable table;
  table.row_begin = {0};
  if (!csv.next()) csv.fail("is empty", "name a file with a signal matrix");
  if (csv.fields()[0].starts_with('#'))
    csv.fail("is a comment, which a matrix cannot have", "remove the line");
  // A header's first field is no number: it stands above ids or is one.
  if (to_number(csv.fields()[0]))
    read_plain_rows(table, csv);
  else
    read_rows_with_ids(table, csv);
  return table;
}

}  // namespace shelfbeam::detail
