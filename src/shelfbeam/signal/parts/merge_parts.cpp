#include "shelfbeam/signal/parts/merge_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/hdf5/signal_part.hpp"
#include "shelfbeam/signal/parts/state_summary.hpp"

namespace shelfbeam {

using detail::SignalPart;

namespace {

constexpr auto only_one_simulation = "merge only parts of the same store, with the same options";

[[noreturn]] void refuse(const SignalPart& part, const std::string& problem,
                         const std::string& suggestion = only_one_simulation) {
  throw InputError(part.path().string(), problem, suggestion, Setting::part);
}

// All parts in their order.
std::vector<SignalPart> open_all(std::span<const std::filesystem::path> paths) {
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
        "simulate them, or name their files", Setting::part);
  }
  return parts;
}

// The first property in which parts of one simulation cannot differ; empty if there is none.
std::string difference(const SignalMatrix& part, const SignalMatrix& first) {
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
  if (part.part.hard_labels != first.part.hard_labels)
    return differs("number of hard labels", part.part.hard_labels, first.part.hard_labels);
  if (part.transceivers != first.transceivers) return "its candidates differ";
  return {};
}

void expect_same(const SignalPart& file, const SignalMatrix& part, const SignalPart& first_file,
                 const SignalMatrix& first) {
  if (const std::string found = difference(part, first); !found.empty())
    refuse(file,
           fmt::format("belongs to another simulation than '{}': {}", first_file.path().string(), found));
}

// The samples of interrupted parts differ between labels.
void expect_complete(const SignalPart& file, const SignalMatrix& part) {
  for (const LabelRow& label : part.labels)
    if (label.samples != part.labels.front().samples)
      refuse(file, "was interrupted: its labels have different numbers of samples",
             "resume its simulation first");
}

template <class T>
void put_row(std::vector<T>& all, std::size_t row, const std::vector<T>& part, std::size_t k,
             std::size_t columns) {
  const auto from = part.begin() + static_cast<std::ptrdiff_t>(k * columns);
  std::copy(from, from + static_cast<std::ptrdiff_t>(columns),
            all.begin() + static_cast<std::ptrdiff_t>(row * columns));
}

// A matrix of `labels` rows with all properties of a part but its labels and entries.
SignalMatrix without_entries(const SignalMatrix& part, std::size_t labels) {
  SignalMatrix all;
  all.transceivers = part.transceivers;
  all.length_step = part.length_step;
  all.wavelength_nm = part.wavelength_nm;
  all.currency = part.currency;
  all.provenance = part.provenance;
  all.labels.resize(labels);
  return all;
}

SignalMatrix joined_labels(const std::vector<SignalPart>& files) {
  std::size_t labels = 0;
  for (const SignalPart& file : files) labels += file.share().members.size();
  const SignalMatrix first = files.front().matrix();
  SignalMatrix all = without_entries(first, labels);
  const std::size_t n = all.columns();
  for (auto* values : {&all.mean, &all.standard_error, &all.direct}) values->resize(labels * n);
  if (!first.flags.empty()) all.flags.resize(labels * n);
  const SignalLayer empty{std::vector<float>(labels * n), std::vector<float>(labels * n)};
  all.by_bounce.assign(first.by_bounce.size(), empty);
  all.by_length.assign(first.by_length.size(), empty);
  std::vector<bool> found(labels);
  for (const SignalPart& file : files) {
    const SignalMatrix part = file.matrix();
    expect_complete(file, part);
    expect_same(file, part, files.front(), first);
    for (std::size_t k = 0; k < part.rows(); ++k) {
      const std::uint32_t i = part.part.members[k];
      if (i >= labels || found[i]) refuse(file, fmt::format("has label {} of {} labels", i, labels));
      found[i] = true;
      all.labels[i] = part.labels[k];
      put_row(all.mean, i, part.mean, k, n);
      put_row(all.standard_error, i, part.standard_error, k, n);
      put_row(all.direct, i, part.direct, k, n);
      if (!all.flags.empty() && !part.flags.empty()) put_row(all.flags, i, part.flags, k, n);
      const auto put_layers = [&](std::vector<SignalLayer>& layers, const std::vector<SignalLayer>& of_part) {
        for (std::size_t l = 0; l < layers.size(); ++l) {
          put_row(layers[l].mean, i, of_part[l].mean, k, n);
          put_row(layers[l].standard_error, i, of_part[l].standard_error, k, n);
        }
      };
      put_layers(all.by_bounce, part.by_bounce);
      put_layers(all.by_length, part.by_length);
    }
  }
  return all;
}

SignalMatrix joined_states(const std::vector<SignalPart>& files) {
  const SignalMatrix first = files.front().matrix();
  SignalMatrix all = without_entries(first, 0);
  all.labels = first.labels;
  all.direct = first.direct;
  detail::StateSummary summary(all, first.part.hard_labels);
  for (const SignalPart& file : files) {
    {
      const SignalMatrix part = file.matrix();
      expect_same(file, part, files.front(), first);
      if (part.states.states == 0 || part.labels != first.labels || part.states.hard.size() != part.rows())
        refuse(file, "has other labels than the first part");
    }
    for (std::uint32_t k = 0; k < file.share().members.size(); ++k) {
      if (file.share().members[k] != all.states.states)
        refuse(file, fmt::format("has state {} where state {} is missing", file.share().members[k],
                                 all.states.states));
      summary.add(file.state(k, all.rows(), all.columns()));
    }
  }
  summary.finish();
  return all;
}

}  // namespace

MergedParts merge_parts(std::span<const std::filesystem::path> parts, const std::filesystem::path& output) {
  const std::vector<SignalPart> files = open_all(parts);
  const bool has_states = files.front().share().hard_labels > 0;
  const SignalMatrix all = has_states ? joined_states(files) : joined_labels(files);
  write_signal_file(all, output);
  return {all.rows(), all.columns(), all.states.states};
}

}  // namespace shelfbeam
