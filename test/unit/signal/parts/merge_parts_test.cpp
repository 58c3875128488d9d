#include "shelfbeam/signal/parts/merge_parts.hpp"

#include <numeric>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/parts/state_summary.hpp"

#include "support/testing.hpp"
#include "unit/signal/small_matrix.hpp"

namespace shelfbeam::test {
namespace {

using Paths = std::vector<std::filesystem::path>;

// A matrix and its files: whole, and in parts of every third label.
class MergeParts : public testing::Test {
 protected:
  static constexpr std::uint32_t count = 3;

  static SignalMatrix whole() {
    SignalMatrix matrix = small_matrix();
    for (LabelRow& label : matrix.labels) label.samples = 2096;
    matrix.by_bounce = {{matrix.direct, matrix.standard_error}, {matrix.mean, matrix.standard_error}};
    matrix.by_length = {{matrix.mean, matrix.standard_error}};
    matrix.length_step = 0.5;
    return matrix;
  }

  static StoredSignals part(const SignalMatrix& all, std::uint32_t number) {
    StoredSignals part{all};
    part.part = {number, count, {}, {}};
    part.labels.clear();
    for (std::uint32_t i = number - 1; i < all.rows(); i += count) {
      part.part->members.push_back(i);
      part.labels.push_back(all.labels[i]);
    }
    const auto keep = [&](auto& values) {
      auto kept = values;
      kept.clear();
      for (const std::uint32_t i : part.part->members)
        for (std::size_t j = 0; j < all.columns(); ++j) kept.push_back(values[i * all.columns() + j]);
      values = kept;
    };
    for (auto* values : {&part.mean, &part.standard_error, &part.direct}) keep(*values);
    keep(part.flags);
    for (auto* layers : {&part.by_bounce, &part.by_length})
      for (SignalLayer& layer : *layers) {
        keep(layer.mean);
        keep(layer.standard_error);
      }
    return part;
  }

  std::filesystem::path file(std::uint32_t number, const std::function<void(StoredSignals&)>& change = {}) {
    StoredSignals of_part = part(whole(), number);
    if (change) change(of_part);
    std::filesystem::path path = folder_ / fmt::format("{}-{}.h5", number, ++files_);
    write_signal_file(of_part, path);
    return path;
  }

  template <class... Expected>
  void refused(const Paths& parts, const Expected&... expected) {
    expect_input_error([&] { merge_parts(parts, folder_ / "merged.h5"); }, expected...);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "merged.h5"));
  }

  TempFolder folder_;
  int files_ = 0;
};

TEST_F(MergeParts, JoinsThemInAnyOrderToTheSameBytes) {
  write_signal_file(whole(), folder_ / "whole.h5");
  Paths parts{file(1), file(2), file(3)};
  std::sort(parts.begin(), parts.end());
  do {
    const MergedParts merged = merge_parts(parts, folder_ / "merged.h5");
    EXPECT_EQ(merged.labels, whole().rows());
    EXPECT_EQ(merged.states, 0U);
    EXPECT_TRUE(read_file(folder_ / "merged.h5") == read_file(folder_ / "whole.h5"));
  } while (std::next_permutation(parts.begin(), parts.end()));
}

TEST_F(MergeParts, RefusesMissingAndDuplicatePartsByName) {
  const auto first = file(1), second = file(2), third = file(3), again = file(2);
  refused({first, third}, first.string(), "of 3 parts, number 2 is missing");
  refused({third}, "of 3 parts, numbers 1, 2 are missing");
  refused({first, second, third, again}, again.string(), "is part 2 of 3, as '" + second.string());
  refused({first, second, third, first}, "is part 1 of 3, as '" + first.string());
  refused({first, second, file(3, [](StoredSignals& part) { part.part->count = 4; })}, "3-5.h5",
          "is one of 4 parts, but '" + first.string() + "' is one of 3");
  write_signal_file(whole(), folder_ / "whole.h5");
  refused({folder_ / "whole.h5"}, "whole.h5: is not a part of a simulation");
  expect_input_error([&] { read_signal_file(first); }, first.string(), "is part 1 of 3 of a simulation");
}

TEST_F(MergeParts, RefusesPartsOfOtherSimulations) {
  const auto first = file(1), second = file(2);
  const std::vector<std::pair<std::string, std::function<void(StoredSignals&)>>> changes{
      {"program version", [](StoredSignals& part) { part.provenance.program_version = "0.0.1"; }},
      {"store hash", [](StoredSignals& part) { part.provenance.store_hash[0] = 'f'; }},
      {"seed is '7'", [](StoredSignals& part) { part.provenance.seed = 7; }},
      {"estimator", [](StoredSignals& part) { part.provenance.estimator = "reuse"; }},
      {"number of samples per label is '64'",
       [](StoredSignals& part) {
         for (LabelRow& label : part.labels) label.samples = 64;
       }},
      {"number of bounce layers", [](StoredSignals& part) { part.by_bounce.pop_back(); }},
      {"lengths of paths", [](StoredSignals& part) { part.length_step = 1; }},
      {"candidates differ", [](StoredSignals& part) { part.transceivers[1].id = "other"; }},
      {"was interrupted", [](StoredSignals& part) { part.labels[0].samples /= 2; }},
      {"has label 0 of 7 labels", [](StoredSignals& part) { part.part->members[0] = 0; }},
      {"has label 7 of 7 labels", [](StoredSignals& part) { part.part->members[1] = 7; }}};
  for (const auto& [expected, change] : changes) {
    const auto third = file(3, change);
    refused({first, second, third}, third.string(), expected);
  }
}

// The states of a shop, in parts of consecutive states.
TEST(MergeStates, GivesTheBytesOfOneRun) {
  const TempFolder folder;
  constexpr std::uint32_t states = 5, parts = 2, max_hard = 3;
  const auto signals = [](const SignalMatrix& matrix, std::uint32_t state) {
    std::vector<float> values = matrix.mean;
    for (std::size_t e = 0; e < values.size(); ++e) values[e] += 1e-3F * static_cast<float>((e + state) % 7);
    return values;
  };
  // Some states [first, last), as `simulate_states` summarises them.
  const auto summary = [&](std::uint32_t first, std::uint32_t last, std::size_t hard) {
    SignalMatrix matrix = small_matrix();
    const SignalMatrix base = matrix;
    matrix.flags.clear();
    detail::StateSummary states_of(std::move(matrix), hard);
    for (std::uint32_t k = first; k < last; ++k) states_of.add(signals(base, k));
    return std::move(states_of).result();
  };
  write_signal_file(summary(0, states, max_hard), folder / "whole.h5");
  Paths files;
  for (std::uint32_t number = 1; number <= parts; ++number) {
    const std::uint32_t first = number == 1 ? 0 : 2, last = number == 1 ? 2 : states;
    StoredSignals part = summary(first, last, 1000);
    part.part = {number, parts, std::vector<std::uint32_t>(last - first), max_hard};
    std::iota(part.part->members.begin(), part.part->members.end(), first);
    files.push_back(folder / fmt::format("{}.h5", number));
    write_signal_file(part, files.back());
  }
  std::reverse(files.begin(), files.end());
  EXPECT_EQ(merge_parts(files, folder / "merged.h5").states, states);
  EXPECT_TRUE(read_file(folder / "merged.h5") == read_file(folder / "whole.h5"));
  EXPECT_EQ(read_signal_file(folder / "merged.h5").states->hard.size(), max_hard);
}

}  // namespace
}  // namespace shelfbeam::test
