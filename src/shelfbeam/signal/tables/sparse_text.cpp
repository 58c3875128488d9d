#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/signal/tables/formats.hpp"
#include "shelfbeam/signal/tables/text_scanner.hpp"

namespace shelfbeam::detail {

namespace {

void read_row(SignalTable& table, TextScanner& in, std::uint32_t columns) {
  const auto by_column = [](const SignalEntry& a, const SignalEntry& b) {
    return a.transceiver < b.transceiver;
  };
  const auto begin = static_cast<std::ptrdiff_t>(table.entries.size());
  const std::uint32_t pairs = in.integer("the number of pairs", 0, columns);
  for (std::uint32_t k = 0; k < pairs; ++k) {
    const std::uint32_t column = in.integer("a column number", 0, columns - 1);
    table.entries.push_back({column, in.amount("the signal")});
  }
  in.end_line(fmt::format("{} pairs", pairs));

  const auto first = table.entries.begin() + begin, last = table.entries.end();
  if (!std::is_sorted(first, last, by_column)) std::sort(first, last, by_column);
  const auto twice =
      std::adjacent_find(first, last, [&](const auto& a, const auto& b) { return !by_column(a, b); });
  if (twice != last)
    in.fail(fmt::format("the line has the duplicate column {}", twice->transceiver), "remove one of them");
  table.entries.erase(std::remove_if(first, last, [](const SignalEntry& e) { return e.signal == 0; }), last);
  table.row_begin.push_back(table.entries.size());
}

}  // namespace

SignalTable read_sparse_text(std::string_view text, const std::string& name) {
  TextScanner in(text, name, LineBreaks::matter);
  in.at_end();
  const std::uint32_t rows = in.extent("the number of labels m");
  const std::uint32_t columns = in.extent("the number of transceivers n");
  const double single = in.amount("the single requirement g");
  if (single == 0) in.fail("the single requirement g is 0", "a value greater than 0 is expected");
  in.end_line("'m n g'");

  SignalTable table;
  table.row_begin = {0};
  for (std::uint32_t i = 0; i < rows; ++i) {
    if (in.at_end())
      in.fail(fmt::format("the file ends after {} of {} labels", i, rows), "download it again or correct m");
    read_row(table, in, columns);
  }
  if (!in.at_end())
    in.fail(fmt::format("the file continues after {} labels", rows), "remove the rest or correct m");

  number_labels(table, rows);
  for (SignalTable::Label& label : table.labels) {
    label.requirement = 1;
    label.single_requirement = single;
  }
  number_transceivers(table, columns);
  return table;
}

}  // namespace shelfbeam::detail
