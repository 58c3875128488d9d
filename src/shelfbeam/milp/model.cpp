#include "shelfbeam/milp/model.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"

namespace shelfbeam::milp {

namespace {

// LP readers take these words for the start of a section or for a number, even where a name is expected.
constexpr std::array<std::string_view, 22> reserved = {
    "min",     "max",      "minimize", "maximize", "minimum", "maximum", "st",       "subject",
    "such",    "that",     "bounds",   "bound",    "free",    "inf",     "infinity", "integers",
    "general", "generals", "gen",      "binary",   "bin",     "end"};

std::string lower(std::string_view text) {
  std::string result;
  for (const char c : text) result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

class SafeNames {
 public:
  explicit SafeNames(std::string prefix) : prefix_(std::move(prefix)) {}

  std::string make(const std::string& base, std::size_t position) {
    std::string name;
    for (const char c : base.substr(0, 48)) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    if (name.empty()) name = fmt::format("{}{}", prefix_, position);
    const std::string plain = lower(name);
    const bool is_word = std::find(reserved.begin(), reserved.end(), plain) != reserved.end();
    // Readers take "e12" for a power of ten; no other letter can start a number.
    if (!std::isalpha(static_cast<unsigned char>(name[0])) || plain[0] == 'e' || is_word)
      name = prefix_ + "_" + name;
    std::string unique = name;
    for (int k = 2; !used_.insert(lower(unique)).second; ++k) unique = fmt::format("{}_{}", name, k);
    return unique;
  }

 private:
  std::string prefix_;
  std::unordered_set<std::string> used_{"cost"};
};

/// The sense of a row in LP and MPS files.
struct Sense {
  std::string_view symbol;
  char letter;
};
constexpr Sense at_least{">=", 'G'}, at_most{"<=", 'L'}, equal{"=", 'E'};

/// A row of either file format: one sense, one right-hand side, a safe name.
struct FileRow {
  std::string name;
  Sense sense;
  double bound = 0;
  std::span<const Entry> entries;
};

std::vector<std::string> file_column_names(const Model& model) {
  SafeNames names("x");
  std::vector<std::string> result;
  for (const Column& column : model.columns) result.push_back(names.make(column.name, result.size()));
  return result;
}

/// The rows of `model` in order, with two-sided and unbounded rows converted as in model.hpp. The result
/// refers to the model's entries.
std::vector<FileRow> file_rows(const Model& model) {
  SafeNames names("r");
  std::vector<FileRow> result;
  for (const Row& row : model.rows) {
    const auto add = [&](Sense sense, double bound) {
      result.push_back({names.make(row.name, result.size()), sense, bound, row.entries});
    };
    if (row.lower == row.upper) {
      add(equal, row.lower);
    } else {
      if (row.lower > -infinity) add(at_least, row.lower);
      if (row.upper < infinity) add(at_most, row.upper);
    }
  }
  return result;
}

// Readers limit the length of lines; expressions are wrapped before this number of characters.
constexpr std::size_t line_length = 100;

class Text {
 public:
  void line(const std::string& text) {
    end();
    text_ += text;
  }
  void term(double factor, const std::string& name) {
    const std::string text =
        fmt::format(" {} {} {}", std::signbit(factor) ? '-' : '+', std::abs(factor), name);
    if (text_.size() - line_start_ + text.size() > line_length) {
      end();
      text_ += ' ';
    }
    text_ += text;
  }
  void append(const std::string& text) { text_ += text; }
  const std::string& finish() {
    end();
    return text_;
  }

 private:
  void end() {
    if (!text_.empty()) text_ += '\n';
    line_start_ = text_.size();
  }
  std::string text_;
  std::size_t line_start_ = 0;
};

std::string bounds(const Column& column, const std::string& name) {
  if (column.lower == -infinity && column.upper == infinity) return fmt::format(" {} free", name);
  if (column.lower == column.upper) return fmt::format(" {} = {}", name, column.lower);
  const std::string low = column.lower == -infinity ? "-inf" : fmt::format("{}", column.lower);
  if (column.upper == infinity) return fmt::format(" {} >= {}", name, low);
  return fmt::format(" {} <= {} <= {}", low, name, column.upper);
}

// Bounds are always written, because readers disagree on the default bounds of integer columns.
void put_bounds(std::string& out, const Column& column, const std::string& name) {
  const auto put = [&](std::string_view kind) { out += fmt::format(" {} BND {}\n", kind, name); };
  const auto put_value = [&](std::string_view kind, double value) {
    out += fmt::format(" {} BND {} {}\n", kind, name, value);
  };
  if (column.lower == column.upper) return put_value("FX", column.lower);
  if (column.lower == -infinity && column.upper == infinity) return put("FR");
  column.lower == -infinity ? put("MI") : put_value("LO", column.lower);
  column.upper == infinity ? put("PL") : put_value("UP", column.upper);
}

}  // namespace

void write_lp(const Model& model, const std::filesystem::path& path) {
  // The format requires a column in every row and in the objective.
  Model full = model;
  if (full.columns.empty()) full.columns.push_back({0, 0, 0, false, "nothing"});
  const auto names = file_column_names(full);

  Text text;
  text.line("Minimize");
  text.line(" cost:");
  for (std::size_t j = 0; j < names.size(); ++j) text.term(full.columns[j].cost, names[j]);
  text.line("Subject To");
  for (const auto& row : file_rows(full)) {
    text.line(fmt::format(" {}:", row.name));
    for (const Entry& entry : row.entries) text.term(entry.value, names[entry.column]);
    if (row.entries.empty()) text.term(0, names[0]);
    text.append(fmt::format(" {} {}", row.sense.symbol, row.bound));
  }
  text.line("Bounds");
  for (std::size_t j = 0; j < names.size(); ++j) text.line(bounds(full.columns[j], names[j]));
  bool titled = false;
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (!full.columns[j].integer) continue;
    if (!titled) text.line("Generals");
    titled = true;
    text.line(" " + names[j]);
  }
  text.line("End");
  write_file(path, text.finish());
}

void write_mps(const Model& model, const std::filesystem::path& path) {
  const auto rows = file_rows(model);
  const auto names = file_column_names(model);
  std::vector<std::vector<std::pair<std::size_t, double>>> by_column(model.columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Entry& entry : rows[i].entries) by_column[entry.column].emplace_back(i, entry.value);

  std::string out;
  out += "NAME shelfbeam FREE\nROWS\n N cost\n";
  for (const auto& row : rows) out += fmt::format(" {} {}\n", row.sense.letter, row.name);
  out += "COLUMNS\n";
  bool integer = false;
  int markers = 0;
  const auto mark = [&](bool is_integer) {
    if (is_integer == integer) return;
    out += fmt::format(" M{} 'MARKER' '{}'\n", ++markers, is_integer ? "INTORG" : "INTEND");
    integer = is_integer;
  };
  for (std::size_t j = 0; j < names.size(); ++j) {
    mark(model.columns[j].integer);
    out += fmt::format(" {} cost {}\n", names[j], model.columns[j].cost);
    for (const auto& [row, value] : by_column[j])
      out += fmt::format(" {} {} {}\n", names[j], rows[row].name, value);
  }
  mark(false);
  out += "RHS\n";
  for (const auto& row : rows)
    if (row.bound != 0) out += fmt::format(" RHS {} {}\n", row.name, row.bound);
  out += "BOUNDS\n";
  for (std::size_t j = 0; j < names.size(); ++j) put_bounds(out, model.columns[j], names[j]);
  out += "ENDATA\n";
  write_file(path, out);
}

}  // namespace shelfbeam::milp
