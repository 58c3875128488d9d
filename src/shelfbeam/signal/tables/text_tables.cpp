#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/tables/formats.hpp"

namespace shelfbeam::detail {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f';
}

// A row or column that nothing refers to needs no character of the text, so small texts get some slack.
constexpr std::size_t slack = 1 << 16;

enum class LineBreaks {
  matter,  ///< a number must stand on the line that is being read; `at_end` moves to the next line
  blank    ///< a line break is as good as a blank
};

/// Reads blank-separated numbers from a text; what does not fit throws InputError with file, line and place.
class TextScanner {
 public:
  /// `name` stands for the file in errors. The text must outlive the scanner.
  TextScanner(std::string_view text, std::string name, LineBreaks line_breaks)
      : text_(text), name_(std::move(name)), line_breaks_(line_breaks) {}

  /// True when only blanks and line breaks are left; else stands before the next number.
  bool at_end() {
    skip_blanks();
    while (position_ < text_.size() && text_[position_] == '\n') {
      line_begin_ = ++position_;
      ++line_;
      skip_blanks();
    }
    return position_ == text_.size();
  }
  /// Throws unless the line ends here.
  void end_line(std::string_view what) {
    skip_blanks();
    if (position_ < text_.size() && text_[position_] != '\n')
      fail(fmt::format("the line goes on after {}", what), "remove the rest or correct the count");
  }

  /// The next whole number, within [low, high].
  std::uint32_t whole(std::string_view what, std::uint32_t low, std::uint32_t high) {
    const std::string_view word = token(what);
    std::int64_t value = 0;
    const char* end = word.data() + word.size();
    const auto [stopped, error] = std::from_chars(word.data(), end, value);
    if (stopped != end || error == std::errc::invalid_argument)
      fail(fmt::format("{} is '{}'", what, word.substr(0, 40)), "a whole number is expected");
    if (error != std::errc{} || value < low || value > high)
      fail(fmt::format("{} is {}", what, word.substr(0, 40)),
           fmt::format("a number from {} to {} is expected", low, high));
    return static_cast<std::uint32_t>(value);
  }
  /// The next number; finite and not negative.
  double amount(std::string_view what) {
    const std::string_view word = token(what);
    const auto value = to_number(word);
    if (!value) fail(fmt::format("{} is '{}'", what, word.substr(0, 40)), "a number is expected");
    if (const auto problem = amount_problem(*value); !problem.empty())
      fail(fmt::format("{} {}", what, problem), "a finite number that is not negative is expected");
    return *value;
  }
  /// A count from a file's first line. Throws when it is 0 or so large that the text could not bear it, so
  /// that memory may be taken for it.
  std::uint32_t extent(std::string_view what) {
    const std::uint32_t count = whole(what, 1, std::numeric_limits<std::uint32_t>::max() - 1);
    if (count > std::max(text_.size(), slack))
      fail(fmt::format("{} is {}, more than a file of {} characters can hold", what, count, text_.size()),
           "correct the count, or fetch the file again if it is truncated");
    return count;
  }

  /// How many characters have been read.
  std::size_t position() const { return position_; }
  /// At the number that was read last.
  [[noreturn]] void fail(const std::string& problem, const std::string& suggestion) const {
    throw InputError(fmt::format("{}: line {}, character {}", name_, line_, token_ - line_begin_ + 1),
                     problem, suggestion);
  }

 private:
  void skip_blanks() {
    while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
    token_ = position_;
  }
  std::string_view token(std::string_view what) {
    if (line_breaks_ == LineBreaks::blank)
      at_end();
    else
      skip_blanks();
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_blank(text_[position_]) && text_[position_] != '\n') ++position_;
    if (position_ == begin)
      fail(fmt::format("the {} ends where {} is expected", position_ == text_.size() ? "file" : "line", what),
           "check that the file is complete and its counts are right");
    return text_.substr(begin, position_ - begin);
  }

  std::string_view text_;
  std::string name_;
  LineBreaks line_breaks_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  std::size_t line_begin_ = 0;
  std::size_t token_ = 0;  ///< where the last token began, for errors
};

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
    const std::uint32_t count = in.whole("the number of columns of a row", 0, extent.columns);
    for (std::uint32_t k = 0; k < count; ++k)
      entries.push_back({in.whole("a column number", 1, extent.columns) - 1, 1});
    const auto first = entries.begin() + static_cast<std::ptrdiff_t>(row_begin.back());
    std::sort(first, entries.end(),
              [](const auto& a, const auto& b) { return a.transceiver < b.transceiver; });
    row_begin.push_back(entries.size());
  }
  if (!in.at_end()) in.fail("the file goes on after the last row", "remove the rest or correct the counts");

  SignalTable table = covering_table(extent, costs);
  table.entries = std::move(entries);
  table.row_begin = std::move(row_begin);
  return table;
}

// Column-wise: a line a column with its cost, a count and the rows that it covers (from 1).
SignalTable read_rail(TextScanner& in) {
  const Extent extent = read_extent(in);
  std::vector<double> costs;
  std::vector<std::uint32_t> covered;  // rows from 0, column after column
  std::vector<std::size_t> column_begin = {0};
  for (std::uint32_t j = 0; j < extent.columns; ++j) {
    if (in.at_end())
      in.fail(fmt::format("the file ends after {} of {} columns", j, extent.columns),
              "fetch it again or correct n");
    costs.push_back(in.amount("the cost of a column"));
    const std::uint32_t count = in.whole("the number of rows of a column", 0, extent.rows);
    for (std::uint32_t k = 0; k < count; ++k) covered.push_back(in.whole("a row number", 1, extent.rows) - 1);
    in.end_line(fmt::format("{} row numbers", count));
    column_begin.push_back(covered.size());
  }
  if (!in.at_end())
    in.fail(fmt::format("the file goes on after {} columns", extent.columns), "remove the rest or correct n");

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

void read_row(SignalTable& table, TextScanner& in, std::uint32_t columns) {
  const auto by_column = [](const SignalEntry& a, const SignalEntry& b) {
    return a.transceiver < b.transceiver;
  };
  const auto begin = static_cast<std::ptrdiff_t>(table.entries.size());
  const std::uint32_t pairs = in.whole("the number of pairs", 0, columns);
  for (std::uint32_t k = 0; k < pairs; ++k) {
    const std::uint32_t column = in.whole("a column number", 0, columns - 1);
    table.entries.push_back({column, in.amount("the signal")});
  }
  in.end_line(fmt::format("{} pairs", pairs));

  const auto first = table.entries.begin() + begin, last = table.entries.end();
  if (!std::is_sorted(first, last, by_column)) std::sort(first, last, by_column);
  const auto twice =
      std::adjacent_find(first, last, [&](const auto& a, const auto& b) { return !by_column(a, b); });
  if (twice != last)
    in.fail(fmt::format("the line names column {} twice", twice->transceiver), "remove one of the pairs");
  table.entries.erase(std::remove_if(first, last, [](const SignalEntry& e) { return e.signal == 0; }), last);
  table.row_begin.push_back(table.entries.size());
}

}  // namespace

SignalTable read_or_library(std::string_view text, const std::string& name) {
  // Nothing in the file says which of the two it is. The rail form is the stricter; where neither fits, the
  // one that got further tells what is wrong.
  const auto read = [&] {
    TextScanner rail(text, name, LineBreaks::matter), scp(text, name, LineBreaks::blank);
    try {
      return read_rail(rail);
    } catch (const InputError& as_rail) {
      try {
        return read_scp(scp);
      } catch (const InputError&) {
        if (rail.position() >= scp.position()) throw as_rail;
        throw;
      }
    }
  };
  SignalTable table = read();
  check_no_repeats(table, name);
  return table;
}

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
      in.fail(fmt::format("the file ends after {} of {} labels", i, rows), "fetch it again or correct m");
    read_row(table, in, columns);
  }
  if (!in.at_end())
    in.fail(fmt::format("the file goes on after {} labels", rows), "remove the rest or correct m");

  number_labels(table, rows);
  for (SignalTable::Label& label : table.labels) {
    label.requirement = 1;
    label.single_requirement = single;
  }
  number_transceivers(table, columns);
  return table;
}

}  // namespace shelfbeam::detail
