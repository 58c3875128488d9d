#include "shelfbeam/signal/tables/npy_header.hpp"

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::string_view blanks(" \t\r\n\f\v\0", 7);

/// The items of a Python dictionary, tuple or list: the texts between commas outside of brackets and strings.
/// Nothing if brackets or strings do not end.
std::optional<std::vector<std::string_view>> items_of(std::string_view text) {
  std::vector<std::string_view> items;
  std::string open;  // the brackets that must close
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\'' || c == '"') {
      i = text.find(c, i + 1);
      if (i == std::string_view::npos) return std::nullopt;
    } else if (c == '(' || c == '[' || c == '{') {
      open += c == '(' ? ')' : c == '[' ? ']' : '}';
    } else if (c == ')' || c == ']' || c == '}') {
      if (open.empty() || open.back() != c) return std::nullopt;
      open.pop_back();
    } else if (c == ',' && open.empty()) {
      items.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
  }
  if (!open.empty()) return std::nullopt;
  // A comma may follow the last item.
  if (text.substr(begin).find_first_not_of(blanks) != std::string_view::npos)
    items.push_back(text.substr(begin));
  return items;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The text between a pair of brackets.
std::optional<std::string_view> inside(std::string_view text, std::initializer_list<std::string_view> pairs) {
  for (const std::string_view pair : pairs)
    if (text.size() > 1 && text.front() == pair[0] && text.back() == pair[1])
      return text.substr(1, text.size() - 2);
  return std::nullopt;
}

/// A Python string: 'f4', "f4", u'f4'.
std::optional<std::string_view> string_of(std::string_view text) {
  if (text.starts_with('u') || text.starts_with('b')) text.remove_prefix(1);
  return inside(text, {"''", "\"\""});
}

/// A Python integer, which may have the suffix of Python 2: 3, 3L.
std::optional<std::size_t> count_of(std::string_view text) {
  if (text.ends_with('L')) text.remove_suffix(1);
  std::size_t count = 0;
  const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (text.empty() || error != std::errc{} || stopped != text.data() + text.size()) return std::nullopt;
  return count;
}

[[noreturn]] void fail(const std::string& name, const std::string& problem, const std::string& suggestion) {
  throw InputError(name + ": header", problem, suggestion);
}

std::map<std::string_view, std::string_view> entries_of(std::string_view text, const std::string& name) {
  const auto content = inside(without_blanks(text), {"{}"});
  const auto items = content ? items_of(*content) : std::nullopt;
  if (!items) fail(name, "is not a Python dictionary", "write the file again with numpy.save");
  std::map<std::string_view, std::string_view> entries;
  for (const std::string_view item : *items) {
    const std::size_t colon = std::min(item.find(':'), item.size());
    const auto key = string_of(without_blanks(item.substr(0, colon)));
    const bool is_known = key && (*key == "descr" || *key == "fortran_order" || *key == "shape");
    if (!is_known ||
        !entries.emplace(*key, without_blanks(item.substr(std::min(colon + 1, item.size())))).second)
      fail(name, fmt::format("has the unknown or duplicate entry {}", in_quotes(without_blanks(item))),
           "write the file again with numpy.save");
  }
  for (const std::string_view key : {"descr", "fortran_order", "shape"})
    if (!entries.contains(key))
      fail(name, fmt::format("is missing '{}'", key), "write the file again with numpy.save");
  return entries;
}

}  // namespace

NpyHeader parse_npy_header(std::string_view text, const std::string& name) {
  auto entries = entries_of(text, name);
  NpyHeader header;
  const std::string_view type = string_of(entries["descr"]).value_or("");
  const auto is_one_of = [&](std::initializer_list<std::string_view> known) {
    return std::find(known.begin(), known.end(), type) != known.end();
  };
  header.is_double = is_one_of({"<f8", "=f8", "f8", "float64"});
  if (!header.is_double && !is_one_of({"<f4", "=f4", "f4", "float32"}))
    fail(name, fmt::format("the data have type {}", shortened(entries["descr"], 100)),
         type.starts_with('>') ? "big-endian is not supported: save matrix.astype('<f4')"
                               : "'<f4' and '<f8' are supported: save matrix.astype('<f4')");

  const std::string_view order = entries["fortran_order"];
  if (order != "True" && order != "False")
    fail(name, "'fortran_order' is neither True nor False", "write it again");
  header.columns_first = order == "True";

  const auto extents = items_of(inside(entries["shape"], {"()", "[]"}).value_or(""));
  constexpr std::size_t max_extent = std::numeric_limits<std::uint32_t>::max() - 1;
  const auto extent = [&](std::size_t k) {
    const auto count = count_of(without_blanks((*extents)[k]));
    return count && *count <= max_extent ? *count : 0;
  };
  if (extents && extents->size() == 2) {
    header.rows = extent(0);
    header.columns = extent(1);
  }
  if (header.rows == 0 || header.columns == 0)
    fail(name, fmt::format("the shape is {}", shortened(entries["shape"], 100)),
         "a matrix (labels, transceivers) is expected");
  return header;
}

}  // namespace shelfbeam::detail
