#include "shelfbeam/signal/parts/part_files.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::detail {

namespace {

// The first property in which parts of one simulation cannot differ; empty if there is none.
std::string difference(const StoredSignals& part, const StoredSignals& first) {
  const Provenance &a = part.provenance, &b = first.provenance;
  const auto differs = [](std::string_view name, const auto& theirs, const auto& ours) {
    return fmt::format("its {} is {} instead of {}", name, in_quotes(fmt::format("{}", theirs)),
                       in_quotes(fmt::format("{}", ours)));
  };
  if (a.program_version != b.program_version)
    return differs("program version", a.program_version, b.program_version);
  if (a.store_hash != b.store_hash) return differs("store hash", a.store_hash, b.store_hash);
  if (a.seed != b.seed) return differs("seed", a.seed, b.seed);
  if (a.estimator != b.estimator) return differs("estimator", a.estimator, b.estimator);
  if (part.labels.front().samples != first.labels.front().samples)
    return differs("number of samples per label", part.labels.front().samples, first.labels.front().samples);
  if (part.by_bounce.size() != first.by_bounce.size())
    return differs("number of bounce layers", part.by_bounce.size(), first.by_bounce.size());
  if (part.by_length.size() != first.by_length.size() || part.length_step != first.length_step)
    return "its lengths of paths differ";
  if (part.part->hard_labels != first.part->hard_labels)
    return differs("number of hard labels", part.part->hard_labels.value_or(0),
                   first.part->hard_labels.value_or(0));
  if (part.transceivers != first.transceivers) return "its candidates differ";
  return {};
}

}  // namespace

void refuse(const SignalPart& part, const std::string& problem, const std::string& suggestion) {
  throw InputError(part.path().string(), problem, suggestion);
}

std::vector<SignalPart> open_parts(std::span<const std::filesystem::path> paths) {
  std::vector<SignalPart> parts;
  for (const auto& path : paths) parts.emplace_back(path);
  const std::uint32_t count = parts.front().share().count;
  for (const SignalPart& part : parts)
    if (part.share().count != count)
      refuse(part, fmt::format("is one of {} parts, but '{}' is one of {}", part.share().count,
                               parts.front().path().string(), count));
  std::stable_sort(parts.begin(), parts.end(), [](const SignalPart& a, const SignalPart& b) {
    return a.share().number < b.share().number;
  });
  for (std::size_t k = 1; k < parts.size(); ++k)
    if (parts[k].share().number == parts[k - 1].share().number)
      refuse(parts[k],
             fmt::format("is part {} of {}, as '{}' is", parts[k].share().number, count,
                         parts[k - 1].path().string()),
             "merge each part once");
  if (parts.size() < count) {
    std::vector<std::uint32_t> missing;
    std::size_t next = 0;
    for (std::uint32_t number = 1; number <= count; ++number)
      if (next < parts.size() && parts[next].share().number == number)
        ++next;
      else
        missing.push_back(number);
    constexpr std::size_t max_named = 20;
    const std::size_t others = missing.size() - std::min(missing.size(), max_named);
    missing.resize(missing.size() - others);
    throw InputError(
        fmt::format("parts of '{}'", parts.front().path().string()),
        fmt::format("of {} parts, {} {}{} {} missing", count, missing.size() == 1 ? "number" : "numbers",
                    fmt::join(missing, ", "), others > 0 ? fmt::format(" and {} more", others) : "",
                    missing.size() + others == 1 ? "is" : "are"),
        "simulate them, or name their files");
  }
  return parts;
}

void expect_same(const SignalPart& file, const StoredSignals& part, const SignalPart& first_file,
                 const StoredSignals& first) {
  if (const std::string found = difference(part, first); !found.empty())
    refuse(file,
           fmt::format("belongs to a different simulation from '{}': {}", first_file.path().string(), found));
}

}  // namespace shelfbeam::detail
