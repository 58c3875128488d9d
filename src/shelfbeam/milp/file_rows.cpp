#include "shelfbeam/milp/file_rows.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

namespace shelfbeam::milp::detail {

namespace {

// LP readers take these for the start of a section or for a number, wherever a name may stand.
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

  std::string make(const std::string& wanted, std::size_t position) {
    std::string name;
    for (const char c : wanted.substr(0, 48)) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    if (name.empty()) name = fmt::format("{}{}", prefix_, position);
    const std::string plain = lower(name);
    const bool is_word = std::find(reserved.begin(), reserved.end(), plain) != reserved.end();
    // "e12" reads as a power of ten; no other letter can be taken for the start of a number.
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

}  // namespace

std::vector<std::string> file_column_names(const Model& model) {
  SafeNames names("x");
  std::vector<std::string> result;
  for (const Column& column : model.columns) result.push_back(names.make(column.name, result.size()));
  return result;
}

std::vector<FileRow> file_rows(const Model& model) {
  SafeNames names("r");
  std::vector<FileRow> result;
  for (const Row& row : model.rows) {
    const auto add = [&](Sense sense, double bound) {
      result.push_back({names.make(row.name, result.size()), sense, bound, row.entries});
    };
    if (row.lower == row.upper) {
      add(Sense::equal, row.lower);
    } else {
      if (row.lower > -infinity) add(Sense::at_least, row.lower);
      if (row.upper < infinity) add(Sense::at_most, row.upper);
    }
  }
  return result;
}

}  // namespace shelfbeam::milp::detail
