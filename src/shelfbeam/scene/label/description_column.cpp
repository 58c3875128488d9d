#include "shelfbeam/scene/label/description_column.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

std::vector<std::string> column_keys(const CsvReader& header) {
  std::vector<std::string> names = header.column_names();
  for (std::string& name : names) std::replace(name.begin(), name.end(), ' ', '_');
  return names;
}

void fail_repeated(const CsvReader& header, std::string_view name) {
  header.fail(fmt::format("has several columns {}", in_quotes(name)), "rename or remove all but one");
}

std::optional<std::size_t> description_column(const CsvReader& header, std::size_t first) {
  const std::vector<std::string> names = column_keys(header);
  const auto begin = names.begin() + static_cast<std::ptrdiff_t>(std::min(first, names.size()));
  for (const std::string_view known : description_columns) {
    const auto found = std::find(begin, names.end(), known);
    if (found == names.end()) continue;
    if (std::find(found + 1, names.end(), known) != names.end()) fail_repeated(header, known);
    return static_cast<std::size_t>(found - names.begin());
  }
  return {};
}

std::string description_of(std::string_view text) {
  constexpr std::size_t longest = 200;  // bytes
  std::string line;
  bool is_after_blank = true;
  for (std::size_t i = 0; i < text.size();) {
    const Character character = character_at(text, i);
    const bool is_blank = character.code == ' ' || !character.is_printable;
    if (!is_blank)
      line += text.substr(i, character.bytes);
    else if (!is_after_blank)
      line += ' ';
    is_after_blank = is_blank;
    i += character.bytes;
  }
  return shortened(trim(line), longest);
}

}  // namespace shelfbeam
