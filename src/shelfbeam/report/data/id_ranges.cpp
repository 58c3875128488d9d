#include "shelfbeam/report/data/id_ranges.hpp"

#include <charconv>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

struct NumberedId {
  std::string_view prefix, digits;

  explicit NumberedId(std::string_view id) {
    constexpr std::size_t most_digits = 18;  // fit 64 bits
    std::size_t at = id.size();
    while (at > 0 && id.size() - at < most_digits && id[at - 1] >= '0' && id[at - 1] <= '9') --at;
    prefix = id.substr(0, at);
    digits = id.substr(at);
  }

  bool is_followed_by(const NumberedId& next) const {
    if (digits.empty() || next.prefix != prefix) return false;
    std::uint64_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return next.digits == fmt::format("{:0{}}", number + 1, digits.size());
  }
};

}  // namespace

std::vector<std::string> id_ranges(std::span<const std::string> ids) {
  std::vector<std::string> ranges;
  for (std::size_t first = 0, last = 0; first < ids.size(); first = ++last) {
    while (last + 1 < ids.size() && NumberedId(ids[last]).is_followed_by(NumberedId(ids[last + 1]))) ++last;
    ranges.push_back(ids[first]);
    if (last > first) ranges.back() += fmt::format("…{}", NumberedId(ids[last]).digits);
  }
  return ranges;
}

}  // namespace shelfbeam
