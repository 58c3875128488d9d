#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

#include "shelfbeam/base/file.hpp"

#include "support/testing.hpp"
#include "unit/signal/checkpoint/identity.hpp"

namespace shelfbeam::test {
namespace {

struct Items {
  std::vector<std::uint32_t> batches;
  std::vector<std::vector<double>> values;

  // Item i has i + 1 values that identify item and batches.
  static Items with(const std::vector<std::uint32_t>& batches) {
    Items items{batches, {}};
    for (std::size_t i = 0; i < batches.size(); ++i)
      items.values.emplace_back(i + 1, 1.0 / 3 + 10.0 * static_cast<double>(i) + batches[i]);
    return items;
  }
  CheckpointState state(std::uint32_t item) const { return {batches[item], values[item]}; }
  void save(CheckpointFile& file) const {
    file.save([&](std::uint32_t item) { return state(item); });
  }
  static Items load(CheckpointFile& file, std::size_t count) {
    Items items{std::vector<std::uint32_t>(count), std::vector<std::vector<double>>(count)};
    EXPECT_TRUE(file.load([&](std::uint32_t item, const CheckpointState& state) {
      items.batches[item] = state.batches;
      items.values[item].assign(state.values.begin(), state.values.end());
    }));
    return items;
  }
  bool operator==(const Items&) const = default;
};

class Checkpoint : public testing::Test {
 protected:
  Items loaded(std::size_t count = 3) const {
    CheckpointFile file(path, identity, static_cast<std::uint32_t>(count));
    return Items::load(file, count);
  }
  std::string error() const {
    return input_error([&] { loaded(); });
  }
  TempFolder folder;
  std::filesystem::path path = folder / "signal.h5.checkpoint";
};

TEST_F(Checkpoint, HasTheLastStateOfEveryItem) {
  CheckpointFile file(path, identity, 3);
  EXPECT_FALSE(file.load([](auto, const auto&) { FAIL(); }));
  EXPECT_FALSE(file.has_saved());
  Items::with({1, 1, 1}).save(file);
  EXPECT_TRUE(file.has_saved());
  EXPECT_EQ(loaded(), Items::with({1, 1, 1}));
  Items::with({1, 2, 2}).save(file);
  Items::with({1, 2, 3}).save(file);
  EXPECT_EQ(loaded(), Items::with({1, 2, 3}));
  EXPECT_EQ(folder.count(), 1);
  remove_checkpoint(path);
  EXPECT_EQ(folder.count(), 0);
}

TEST_F(Checkpoint, OmitsItemsWithoutBatches) {
  CheckpointFile file(path, identity, 3);
  Items::with({0, 0, 0}).save(file);
  EXPECT_EQ(folder.count(), 0);
  Items::with({0, 4, 0}).save(file);
  EXPECT_EQ(loaded().batches, (std::vector<std::uint32_t>{0, 4, 0}));
  EXPECT_TRUE(loaded().values[0].empty());
}

TEST_F(Checkpoint, WritesOnlyChangesAndStaysSmall) {
  CheckpointFile file(path, identity, 3);
  Items::with({1, 1, 1}).save(file);
  const auto whole = std::filesystem::file_size(path);
  Items::with({1, 1, 1}).save(file);
  EXPECT_EQ(std::filesystem::file_size(path), whole);
  Items::with({2, 1, 1}).save(file);
  EXPECT_EQ(std::filesystem::file_size(path), whole + 24 + 8 + 8);
  for (std::uint32_t b = 3; b < 100; ++b) {
    Items::with({b, b / 2, 1}).save(file);
    EXPECT_LE(std::filesystem::file_size(path), 2 * whole);
  }
  EXPECT_EQ(loaded(), Items::with({99, 49, 1}));
}

TEST_F(Checkpoint, ContinuesTheCheckpointOfAnotherProcess) {
  {
    CheckpointFile file(path, identity, 3);
    Items::with({5, 5, 4}).save(file);
  }
  CheckpointFile file(path, identity, 3);
  Items::load(file, 3);
  Items::with({5, 6, 5}).save(file);
  EXPECT_EQ(loaded(), Items::with({5, 6, 5}));
}

// A program that is killed while appending leaves a part of the record, of any length.
TEST_F(Checkpoint, DropsARecordCutOffAtTheEnd) {
  CheckpointFile first(path, identity, 3);
  Items::with({1, 1, 1}).save(first);
  const std::string before = read_file(path);
  Items::with({1, 2, 1}).save(first);
  const std::string after = read_file(path);
  ASSERT_TRUE(after.starts_with(before));
  for (std::size_t size = before.size(); size < after.size(); ++size) {
    write_file(path, after.substr(0, size));
    CheckpointFile file(path, identity, 3);
    ASSERT_EQ(Items::load(file, 3), Items::with({1, 1, 1})) << size;
    Items::with({1, 1, 3}).save(file);
    ASSERT_EQ(loaded(), Items::with({1, 1, 3})) << size;
  }
  write_file(path, after);
  EXPECT_EQ(loaded(), Items::with({1, 2, 1}));
}

TEST_F(Checkpoint, RefusesAByteChangedAnywhere) {
  CheckpointFile file(path, identity, 3);
  Items::with({1, 1, 1}).save(file);
  const std::string valid_size = read_file(path);
  for (std::size_t at = 0; at < valid_size.size(); ++at) {
    std::string bad = valid_size;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    write_file(path, bad);
    const std::string message = error();
    EXPECT_NE(message.find(path.string()), std::string::npos) << at;
    const bool is_recognised = bad.starts_with("shelfbeam checkpoint ");
    EXPECT_NE(message.find(is_recognised ? "without resuming" : "move it elsewhere"), std::string::npos)
        << at << message;
  }
  write_file(path, valid_size);
  EXPECT_EQ(loaded(), Items::with({1, 1, 1}));
}

// Two processes with different seeds: each has its own file, and the name belongs to the last one created.
TEST_F(Checkpoint, TwoWritersDoNotMix) {
  CheckpointFile ours(path, identity, 3), theirs(path, {{"store hash", "abc"}, {"seed", "2"}}, 3);
  Items::with({1, 1, 1}).save(ours);
  Items::with({7, 7, 7}).save(theirs);
  EXPECT_NE(error().find("seed is '2'"), std::string::npos);
  Items::with({1, 2, 1}).save(ours);
  EXPECT_EQ(loaded(), Items::with({1, 2, 1}));
  Items::with({1, 2, 2}).save(ours);
  EXPECT_EQ(loaded(), Items::with({1, 2, 2}));
  EXPECT_EQ(folder.count(), 1);
}

TEST_F(Checkpoint, IsWrittenAgainAfterAnotherProcessRemovedIt) {
  CheckpointFile file(path, identity, 3);
  Items::with({1, 1, 1}).save(file);
  remove_checkpoint(path);
  Items::with({1, 1, 2}).save(file);
  EXPECT_EQ(loaded(), Items::with({1, 1, 2}));
}

TEST_F(Checkpoint, RemovalIncludesFilesOfKilledWriters) {
  folder.write(".signal.h5.checkpoint.shelfbeam-a1B2c3", "half");
  remove_checkpoint(path);
  EXPECT_EQ(folder.count(), 0);
}

TEST_F(Checkpoint, ANewRunReplacesAnOldOneOnly) {
  write_file(path, "something else\n");
  EXPECT_THROW(CheckpointFile(path, identity, 3), InputError);
  EXPECT_EQ(read_file(path), "something else\n");
  write_file(path, "shelfbeam checkpoint 0\n");
  CheckpointFile file(path, identity, 3);
  Items::with({1, 1, 1}).save(file);
  EXPECT_EQ(loaded(), Items::with({1, 1, 1}));
}

}  // namespace
}  // namespace shelfbeam::test
