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
#include "shelfbeam/signal/parts/part_files.hpp"
#include "shelfbeam/signal/parts/state_summary.hpp"

namespace shelfbeam {

using detail::expect_same;
using detail::refuse;
using detail::SignalPart;

namespace {

// The samples of interrupted parts differ between labels.
void expect_complete(const SignalPart& file, const SignalMatrix& part) {
  for (const LabelRow& label : part.labels)
    if (label.samples != part.labels.front().samples)
      refuse(file, "was interrupted: its labels have different numbers of samples",
             "resume its simulation first");
}

template <class T>
void put_row(std::vector<T>& all, std::size_t row, const std::vector<T>& part, std::size_t k, std::size_t n) {
  const auto from = part.begin() + static_cast<std::ptrdiff_t>(k * n);
  std::copy(from, from + static_cast<std::ptrdiff_t>(n), all.begin() + static_cast<std::ptrdiff_t>(row * n));
}

// A matrix of `labels` rows with all properties of a part but its labels and entries.
SignalMatrix without_entries(const SignalMatrix& part, std::size_t labels) {
  SignalMatrix all;
  all.transceivers = part.transceivers;
  all.length_step = part.length_step;
  all.wavelength_nm = part.wavelength_nm;
  all.excluded = part.excluded;
  all.currency = part.currency;
  all.provenance = part.provenance;
  all.labels.resize(labels);
  return all;
}

StoredSignals joined_labels(const std::vector<SignalPart>& files) {
  std::size_t labels = 0;
  for (const SignalPart& file : files) labels += file.share().members.size();
  const StoredSignals first = files.front().matrix();
  StoredSignals all{without_entries(first, labels)};
  const std::size_t n = all.columns();
  for (auto* values : {&all.mean, &all.standard_error, &all.direct}) values->resize(labels * n);
  if (!first.flags.empty()) all.flags.resize(labels * n);
  const SignalLayer empty{std::vector<float>(labels * n), std::vector<float>(labels * n)};
  all.by_bounce.assign(first.by_bounce.size(), empty);
  all.by_length.assign(first.by_length.size(), empty);
  std::vector<bool> found(labels);
  for (const SignalPart& file : files) {
    const StoredSignals part = file.matrix();
    expect_complete(file, part);
    expect_same(file, part, files.front(), first);
    for (std::size_t k = 0; k < part.rows(); ++k) {
      const std::uint32_t i = part.part->members[k];
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

StoredSignals joined_states(const std::vector<SignalPart>& files) {
  const StoredSignals first = files.front().matrix();
  SignalMatrix head = without_entries(first, 0);
  head.labels = first.labels;
  head.direct = first.direct;
  detail::StateSummary summary(std::move(head), *first.part->hard_labels);
  for (const SignalPart& file : files) {
    {
      const StoredSignals part = file.matrix();
      expect_same(file, part, files.front(), first);
      if (!part.states || part.labels != first.labels || part.states->hard.size() != part.rows())
        refuse(file, "has different labels from the first part");
    }
    for (std::uint32_t k = 0; k < file.share().members.size(); ++k) {
      if (file.share().members[k] != summary.states())
        refuse(file, fmt::format("has state {} where state {} is missing", file.share().members[k],
                                 summary.states()));
      summary.add(file.state(k, first.rows(), first.columns()).mean);
    }
  }
  return std::move(summary).result();
}

}  // namespace

MergedParts merge_parts(std::span<const std::filesystem::path> parts, const std::filesystem::path& output) {
  const std::vector<SignalPart> files = detail::open_parts(parts);
  for (const SignalPart& file : files)
    if (file.serves_plan())
      refuse(file, "serves a plan, which reads all parts itself", "give the parts to the plan");
  const bool has_states = files.front().share().hard_labels.has_value();
  const StoredSignals all = has_states ? joined_states(files) : joined_labels(files);
  write_signal_file(all, output);
  return {all.rows(), all.columns(), all.states ? all.states->states : 0};
}

}  // namespace shelfbeam
