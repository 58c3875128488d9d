#include "serve/text/splice.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

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

std::string spliced(std::string_view text, const std::vector<Splice>& splices) {
  std::string result;
  std::size_t at = 0;
  for (const Splice& splice : splices) {
    if (splice.at < at || splice.at > text.size() || !text.substr(splice.at).starts_with(splice.before))
      throw std::invalid_argument("a replacement is not for this text");
    result.append(text, at, splice.at - at) += splice.after;
    at = splice.at + splice.before.size();
  }
  return result.append(text, at);
}

std::vector<Splice> inverse(std::vector<Splice> splices) {
  std::size_t added = 0, removed = 0;
  for (Splice& splice : splices) {
    splice.at = splice.at + added - removed;
    added += splice.after.size();
    removed += splice.before.size();
    std::swap(splice.before, splice.after);
  }
  return splices;
}

}  // namespace shelfbeam::serve
