#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/milp/file_rows.hpp"
#include "shelfbeam/milp/model_file.hpp"

namespace shelfbeam::milp {

namespace {

// Readers limit the length of a line; expressions are broken before this many characters.
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

const char* symbol(detail::Sense sense) {
  return sense == detail::Sense::at_least ? ">=" : sense == detail::Sense::at_most ? "<=" : "=";
}

std::string bounds(const Column& column, const std::string& name) {
  if (column.lower == -infinity && column.upper == infinity) return fmt::format(" {} free", name);
  if (column.lower == column.upper) return fmt::format(" {} = {}", name, column.lower);
  const std::string low = column.lower == -infinity ? "-inf" : fmt::format("{}", column.lower);
  if (column.upper == infinity) return fmt::format(" {} >= {}", name, low);
  return fmt::format(" {} <= {} <= {}", low, name, column.upper);
}

}  // namespace

void write_lp(const Model& model, const std::filesystem::path& path) {
  // The format knows no row and no objective without a column.
  Model full = model;
  if (full.columns.empty()) full.columns.push_back({0, 0, 0, false, "nothing"});
  const auto names = detail::file_column_names(full);

  Text text;
  text.line("Minimize");
  text.line(" cost:");
  for (std::size_t j = 0; j < names.size(); ++j) text.term(full.columns[j].cost, names[j]);
  text.line("Subject To");
  for (const auto& row : detail::file_rows(full)) {
    text.line(fmt::format(" {}:", row.name));
    for (const Entry& entry : row.entries) text.term(entry.value, names[entry.column]);
    if (row.entries.empty()) text.term(0, names[0]);
    text.append(fmt::format(" {} {}", symbol(row.sense), row.bound));
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

}  // namespace shelfbeam::milp
