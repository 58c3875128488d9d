#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/hdf5_io.hpp"
#include "shelfbeam/signal/hdf5/write_signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/testing.hpp"
#include "unit/signal/small_matrix.hpp"

namespace shelfbeam::test {
namespace {

TEST(SignalFile, KeepsEverythingBitForBit) {
  const TempFolder folder;
  const SignalMatrix written = small_matrix();
  write_signal_file(written, folder / "signal.h5");
  EXPECT_EQ(folder.count(), 1) << "the temporary file must be gone";
  EXPECT_TRUE(is_hdf5(folder / "signal.h5"));

  SignalMatrix read = read_signal_file(folder / "signal.h5");
  EXPECT_TRUE(read == written);
  read.transceivers[1].axis.x = std::nextafter(read.transceivers[1].axis.x, 2);
  EXPECT_FALSE(read == written);
}

TEST(SignalFile, MayHaveNoFlags) {
  const TempFolder folder;
  SignalMatrix written = small_matrix();
  const auto marked = written.flags;
  written.flags.clear();
  write_signal_file(written, folder / "signal.h5");
  EXPECT_TRUE(read_signal_file(folder / "signal.h5").flags.empty());
  written.flags.assign(marked.size(), 0);  // flags are known, and none is set
  write_signal_file(written, folder / "signal.h5");
  EXPECT_EQ(read_signal_file(folder / "signal.h5").flags, written.flags);
  EXPECT_NE(marked, written.flags);
}

// The rows are streamed and fill several chunks: 2^18 of 300,000 columns each.
TEST(SignalFile, WritesFlagsRowByRow) {
  const TempFolder folder;
  SignalRows rows;
  rows.fill = [](const SignalRows::Source&, std::size_t, std::span<float> values) {
    std::fill(values.begin(), values.end(), 1.0F);
  };
  rows.fill_flags = [](std::size_t row, std::span<std::uint8_t> flags) {
    std::fill(flags.begin(), flags.end(), std::uint8_t{0});
    flags[flags.size() - 1 - row] = 1;
  };
  StoredSignals head;
  head.labels.resize(7);
  head.transceivers.resize(300'000);
  write_signal_file(head, rows, folder / "signal.h5");
  const SignalMatrix read = read_signal_file(folder / "signal.h5");
  ASSERT_EQ(read.flags.size(), 7u * 300'000u);
  EXPECT_EQ(std::count(read.flags.begin(), read.flags.end(), 1), 7);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_TRUE(read.is_flagged(read.at(i, 300'000 - 1 - i))) << i;
}

TEST(SignalFile, KeepsTheMatricesOfBouncesAndLengths) {
  const TempFolder folder;
  SignalMatrix written = small_matrix(4, 3);
  written.by_bounce = {{written.mean, written.direct}, {written.direct, written.standard_error}};
  written.by_length = {{written.direct, written.mean}};
  written.length_step = 0.25;
  write_signal_file(written, folder / "signal.h5");
  const SignalMatrix read = read_signal_file(folder / "signal.h5");
  EXPECT_TRUE(read == written);
  EXPECT_FALSE(read.by_bounce[0] == read.by_bounce[1]);
  written.length_step = -1;
  write_signal_file(written, folder / "signal.h5");
  expect_input_error([&] { read_signal_file(folder / "signal.h5"); }, "signal.h5", "length_step");
}

TEST(SignalFile, KeepsTheStatesOfAShop) {
  const TempFolder folder;
  StoredSignals written{small_matrix(4, 3)};
  written.states = StateTensor{2, written.direct, {1, 3}, std::vector<float>(12), {}};
  for (std::size_t k = 0; k < written.states->signal.size(); ++k)
    written.states->signal[k] = static_cast<float>(k) - 2;
  write_signal_file(written, folder / "signal.h5");
  EXPECT_TRUE(read_signal_file(folder / "signal.h5") == written);
  const auto expect_refused = [&](std::vector<LabelId> hard, std::string_view place) {
    written.states->hard = std::move(hard);
    write_signal_file(written, folder / "signal.h5");
    expect_input_error([&] { read_signal_file(folder / "signal.h5"); }, "signal.h5", place);
  };
  expect_refused({1, 4}, "/states/hard");
  expect_refused({3, 1}, "/states/hard");
  written.states->signal[5] = std::numeric_limits<float>::infinity();
  expect_refused({1, 3}, "/states/signal");
}

TEST(SignalFile, BytesDependOnTheMatrixAlone) {
  const TempFolder folder;
  // 700 rows of 500 columns are more than one chunk, and the last chunk extends beyond the matrix.
  SignalMatrix matrix = small_matrix(700, 500);
  write_signal_file(matrix, folder / "first.h5");
  {
    // Freed memory blocks with another value, which must not appear in the file.
    std::vector<std::vector<char>> dirt(64, std::vector<char>(1 << 20, '\x5a'));
    for (std::size_t k = 1; k <= 1000; ++k) dirt.emplace_back(k * 64, '\x5a');
  }
  write_signal_file(read_signal_file(folder / "first.h5"), folder / "second.h5");
  const std::string first = read_file(folder / "first.h5");
  EXPECT_EQ(first, read_file(folder / "second.h5"));

  matrix.mean[12345] = std::nextafter(matrix.mean[12345], 1.0f);  // negative control: one bit is detected
  write_signal_file(matrix, folder / "second.h5");
  EXPECT_NE(first, read_file(folder / "second.h5"));
}

// The message is that of the checksum, so the HDF5 library has not read the file.
TEST(SignalFile, EveryChangedByteIsFound) {
  const TempFolder folder;
  write_signal_file(small_matrix(), folder / "signal.h5");
  const std::string whole = read_file(folder / "signal.h5");
  const std::size_t title = whole.find(": ") + 2;
  for (std::size_t k = 0; k < whole.size(); k += k < 128 ? 1 : 31) {
    std::string damaged = whole;
    damaged[k] = static_cast<char>(damaged[k] ^ (1 << k % 8));
    expect_file_refused(read_signal_file, damaged, k < title ? "not an HDF5 file" : "checksum");
  }
}

TEST(SignalFile, EveryTruncationIsRefused) {
  const TempFolder folder;
  write_signal_file(small_matrix(40, 30), folder / "signal.h5");
  const std::string whole = read_file(folder / "signal.h5");
  constexpr std::size_t cuts = 64;
  for (std::size_t k = 0; k < cuts; ++k) {
    const std::string cut = whole.substr(0, whole.size() * k / cuts);
    expect_file_refused(read_signal_file, cut);
    expect_file_refused(read_signal_table, cut);
  }
  for (const std::string& other : {whole.substr(0, whole.size() - 1), whole + '\0'})
    expect_input_error([&] { read_signal_file(folder.write("cut.h5", other)); }, "cut.h5", "checksum");
  EXPECT_NO_THROW(read_signal_file(folder.write("whole.h5", whole)));
}

TEST(SignalFile, BadNumbersAreNamed) {
  const TempFolder folder;
  const auto refused = [&](auto&& spoil, std::string_view place, std::string_view problem) {
    SignalMatrix matrix = small_matrix();
    spoil(matrix);
    write_signal_file(matrix, folder / "bad.h5");
    expect_input_error([&] { read_signal_table(folder / "bad.h5"); }, "bad.h5", place, problem);
  };
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const char* place = "/mean, label 'A1-front-2', transceiver 'G1-3-0'";
  refused([](SignalMatrix& m) { m.mean[13] = std::numeric_limits<float>::infinity(); }, place, "infinite");
  refused([](SignalMatrix& m) { m.mean[13] = -1.1f, m.standard_error[13] = 0.1f; }, place, "negative");
  refused([](SignalMatrix& m) { m.mean[13] = -1e-9f, m.standard_error[13] = 0; }, place, "negative");
  refused([](SignalMatrix& m) { m.standard_error[3] = std::nanf(""); }, "/standard_error, label", "NaN");
  refused([](SignalMatrix& m) { m.direct[3] = -1; }, "/direct, label", "negative");
  refused([](SignalMatrix& m) { m.flags[13] = 2; }, "/flags, label 'A1-front-2', transceiver 'G1-3-0'",
          "is 2");
  refused([](SignalMatrix& m) { m.labels[1].requirement = -1; }, "/labels/requirement, row 2", "negative");
  refused([](SignalMatrix& m) { m.transceivers[4].cost = infinite; }, "/transceivers/cost, row 5",
          "infinite");
  refused([](SignalMatrix& m) { m.labels[0].position.x = infinite; }, "/labels/position, row 1",
          "not finite");
  refused([](SignalMatrix& m) { m.labels[0].id = m.labels[2].id; }, "label id", "'A1-front-2'");
}

TEST(SignalFile, EstimatesOfZeroMayBeNegative) {
  const TempFolder folder;
  SignalMatrix matrix = small_matrix();
  matrix.mean[13] = -0.2F;
  matrix.standard_error[13] = 0.1F;
  write_signal_file(matrix, folder / "signal.h5");
  EXPECT_EQ(read_signal_file(folder / "signal.h5").mean[13], -0.2F);
  const SignalTable table = read_signal_table(folder / "signal.h5");
  EXPECT_EQ(table.entries.size(), make_signal_table(small_matrix()).entries.size() - 1);
}

// Written by test/data/signal/make_hdf5_files.py.
const std::filesystem::path made = SHELFBEAM_SOURCE_DIR "/test/data/signal";

TEST(SignalFile, ReadsFilesOfH5py) {
  const SignalMatrix matrix = read_signal_file(made / "foreign.h5");
  ASSERT_EQ(matrix.rows(), 2u);
  ASSERT_EQ(matrix.columns(), 3u);
  EXPECT_EQ(matrix.mean, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(matrix.standard_error, std::vector<float>(6, 0.5f));
  EXPECT_TRUE(matrix.flags.empty());
  EXPECT_EQ(matrix.labels[0].id, "L1");
  EXPECT_EQ(matrix.labels[1].id, "L2 longer");
  EXPECT_EQ(matrix.labels[1].requirement, 0.25);
  EXPECT_EQ(matrix.labels[1].samples, 5u);
  EXPECT_TRUE(matrix.transceivers[1].installed);
  EXPECT_EQ(matrix.provenance.store_hash, "");
}

TEST(SignalFile, ForeignFilesThatCannotBeReadAreRefused) {
  const auto refused = [](const char* name, std::string_view place, std::string_view problem) {
    expect_input_error([&] { read_signal_file(made / name); }, name, place, problem);
  };
  refused("claims_labels.h5", "/labels/id", "8000000000000 bytes");
  refused("claims_entries.h5", "/mean: ", "no data");
  refused("old_format.h5", "", "h5repack");
  refused("variable_texts.h5", "/labels/id: ", "fixed length");
  const TempFolder folder;
  const std::string whole = read_file(made / "foreign.h5");
  const auto path = folder.write("cut.h5", whole.substr(0, whole.size() - 1));
  expect_input_error([&] { read_signal_file(path); }, "cut.h5", "truncated");
}

TEST(SignalFile, ReadsFilesWithoutChecksum) {
  const std::filesystem::path old = SHELFBEAM_SOURCE_DIR "/test/system/compatibility/0.1.0/plan/signal.h5";
  ASSERT_TRUE(read_file(old).starts_with("\x89HDF")) << "a file of later versions";
  const SignalMatrix matrix = read_signal_file(old);
  ASSERT_EQ(matrix.rows(), 23u);
  ASSERT_EQ(matrix.columns(), 34u);
  EXPECT_EQ(matrix.mean[2], 0.12526298F);

  // Data that h5py changed in a new file are also read without the checksum block.
  const TempFolder folder;
  write_signal_file(matrix, folder / "new.h5");
  const auto path = folder.write("cut.h5", read_file(folder / "new.h5").substr(512));
  EXPECT_EQ(read_signal_file(path).mean, matrix.mean);
}

TEST(SignalFile, OtherFilesAreRefused) {
  const TempFolder folder;
  expect_input_error([&] { read_signal_file(folder.write("a.h5", "id,T1\nL1,1\n")); }, "a.h5: ", "HDF5");
  expect_input_error([&] { read_signal_file(folder / "missing.h5"); }, "missing.h5: ");
  EXPECT_FALSE(is_hdf5(folder.write("short", "\x89HD")));

  const auto refused = [&](auto&& fill, std::string_view place, std::string_view problem) {
    detail::Hdf5Writer file(folder / "other.h5", "other.h5");
    fill(file);
    file.close();
    expect_input_error([&] { read_signal_table(folder / "other.h5"); }, "other.h5", place, problem);
  };
  using Writer = detail::Hdf5Writer;
  const std::vector<std::string> ids = {"a", "b"};
  const auto attributes = [](Writer& file) {
    file.attribute("format_version", std::uint32_t{1});
    for (const char* text : {"program_version", "store_hash", "estimator"})
      file.attribute(text, std::string("x"));
    file.attribute("seed", std::uint64_t{1});
    file.attribute("wavelength_nm", 940.0);
  };
  const auto sizes = [&](Writer& file) {
    attributes(file);
    file.group("/labels");
    file.group("/transceivers");
    file.texts("/labels/id", ids);
    file.texts("/transceivers/id", ids);
  };
  refused([](Writer&) {}, "", "'simulate'");
  refused([](Writer& f) { f.attribute("format_version", std::uint32_t{2}); }, "", "format version 2");
  refused([](Writer& f) { f.attribute("format_version", std::string("1")); }, "format_version", "wrong type");
  refused([](Writer& f) { f.attribute("format_version", std::uint32_t{1}); }, "program_version", "missing");
  refused(attributes, "/labels/id", "missing");
  refused(
      [&](Writer& file) {
        attributes(file);
        file.group("/labels");
        file.group("/transceivers");
        file.texts("/labels/id", std::vector<std::string>{"a", "b\xE2\x80\xAE"});
        file.texts("/transceivers/id", ids);
      },
      "/labels/id, row 2: ", "unprintable character '\\u202e'");
  refused(sizes, "/labels/type", "missing");
  refused(
      [&](Writer& file) {
        sizes(file);
        file.texts("/labels/type", std::vector<std::string>{"a"});
      },
      "/labels/type", "(1)");
  refused(
      [&](Writer& file) {
        sizes(file);
        file.numbers("/labels/type", std::span<const double>(std::vector<double>{1, 2}), {2});
      },
      "/labels/type: ", "fixed length");
}

TEST(SignalFile, FailedWritesLeaveNothing) {
  const TempFolder folder;
  const SignalMatrix matrix = small_matrix();
  expect_input_error([&] { write_signal_file(matrix, folder / "none/signal.h5"); }, "none/signal.h5");
  SignalMatrix uneven = matrix;
  uneven.direct.pop_back();
  EXPECT_THROW(write_signal_file(uneven, folder / "signal.h5"), std::invalid_argument);
  uneven = matrix;
  uneven.flags.pop_back();
  EXPECT_THROW(write_signal_file(uneven, folder / "signal.h5"), std::invalid_argument);
  EXPECT_THROW(write_signal_file(SignalMatrix(), folder / "signal.h5"), std::invalid_argument);
  EXPECT_EQ(folder.count(), 0);
}

}  // namespace
}  // namespace shelfbeam::test
