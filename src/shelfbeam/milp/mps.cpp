#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/milp/file_rows.hpp"
#include "shelfbeam/milp/model_file.hpp"

namespace shelfbeam::milp {

namespace {

using Buffer = fmt::memory_buffer;

template <class... Arguments>
void put(Buffer& out, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Arguments>(arguments)...);
}

char letter(detail::Sense sense) {
  return sense == detail::Sense::at_least ? 'G' : sense == detail::Sense::at_most ? 'L' : 'E';
}

// Bounds are always written: readers disagree on what an integer column without any has.
void put_bounds(Buffer& out, const Column& column, const std::string& name) {
  if (column.lower == column.upper) {
    put(out, " FX BND {} {}\n", name, column.lower);
  } else if (column.lower == -infinity && column.upper == infinity) {
    put(out, " FR BND {}\n", name);
  } else {
    if (column.lower == -infinity)
      put(out, " MI BND {}\n", name);
    else
      put(out, " LO BND {} {}\n", name, column.lower);
    if (column.upper == infinity)
      put(out, " PL BND {}\n", name);
    else
      put(out, " UP BND {} {}\n", name, column.upper);
  }
}

}  // namespace

void write_mps(const Model& model, const std::filesystem::path& path) {
  const auto rows = detail::file_rows(model);
  const auto names = detail::file_column_names(model);
  std::vector<std::vector<std::pair<std::size_t, double>>> by_column(model.columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Entry& entry : rows[i].entries) by_column[entry.column].emplace_back(i, entry.value);

  Buffer out;
  put(out, "NAME shelfbeam FREE\nROWS\n N cost\n");
  for (const auto& row : rows) put(out, " {} {}\n", letter(row.sense), row.name);
  put(out, "COLUMNS\n");
  bool integer = false;
  int markers = 0;
  const auto mark = [&](bool wanted) {
    if (wanted == integer) return;
    put(out, " M{} 'MARKER' '{}'\n", ++markers, wanted ? "INTORG" : "INTEND");
    integer = wanted;
  };
  for (std::size_t j = 0; j < names.size(); ++j) {
    mark(model.columns[j].integer);
    put(out, " {} cost {}\n", names[j], model.columns[j].cost);
    for (const auto& [row, value] : by_column[j]) put(out, " {} {} {}\n", names[j], rows[row].name, value);
  }
  mark(false);
  put(out, "RHS\n");
  for (const auto& row : rows)
    if (row.bound != 0) put(out, " RHS {} {}\n", row.name, row.bound);
  put(out, "BOUNDS\n");
  for (std::size_t j = 0; j < names.size(); ++j) put_bounds(out, model.columns[j], names[j]);
  put(out, "ENDATA\n");
  write_file(path, {out.data(), out.size()});
}

}  // namespace shelfbeam::milp
