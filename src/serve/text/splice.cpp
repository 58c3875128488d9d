#include "serve/text/splice.hpp"

#include <algorithm>

namespace shelfbeam::serve {

Splice splice_between(std::string_view before, std::string_view after) {
  const std::size_t shorter = std::min(before.size(), after.size());
  const auto equal = [](auto a, auto b, std::size_t most) {
    return static_cast<std::size_t>(std::mismatch(a, a + static_cast<std::ptrdiff_t>(most), b).first - a);
  };
  const std::size_t front = equal(before.begin(), after.begin(), shorter);
  const std::size_t back = equal(before.rbegin(), after.rbegin(), shorter - front);
  return {front, std::string(before.substr(front, before.size() - front - back)),
          std::string(after.substr(front, after.size() - front - back))};
}

std::string spliced(std::string_view text, const Splice& splice) {
  std::string result(text);
  return result.replace(splice.at, splice.before.size(), splice.after);
}

}  // namespace shelfbeam::serve
