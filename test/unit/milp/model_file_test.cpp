#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/milp/model.hpp"
#include "shelfbeam/milp/solver.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/milp/example_models.hpp"

namespace shelfbeam::milp {
namespace {

struct Format {
  const char* file;
  void (*write)(const Model&, const std::filesystem::path&);
};
constexpr Format formats[] = {{"model.mps", write_mps}, {"model.lp", write_lp}};

// Ids and numbers that a careless writer or reader would corrupt.
Model awkward() {
  Model model;
  model.columns = {{1, 0, 1, true, "G1-0-0"},
                   {0.1, 0, 1, true, "e12"},
                   {1e-9 / 3, 0, 1, true, "G1_0 0"},
                   {-2.5, -3, 7, true, "st"},
                   {0, 0, 5, true, ""},
                   {1e6 / 7, -infinity, infinity, false, "12é"},
                   {0, 1, 1, true, "free"},
                   {3, -infinity, 2.5, false, "neg"},
                   {4, -1.5, infinity, false, std::string(300, 'x')},
                   {0, 0, 1, true, "unused"}};
  model.rows = {{1, infinity, {{0, 1}, {1, 1.0 / 3}, {2, 1e-7 / 3}}, "A1-front-1-3"},
                {-infinity, 4, {{3, 1}, {4, 2}, {7, -1}}, "cost"},
                {2, 2, {{5, 1}, {6, 1}}, "A1-front-1-3"},
                {-1, 3.3, {{0, 1}, {3, -1}, {8, 0.25}}, "both"},
                {-infinity, infinity, {{0, 1}}, "no bound"},
                {-infinity, 9, {}, "no entry"}};
  return model;
}

// The rows in the files: two for a row with two bounds, none for a row without.
std::vector<Row> in_file(const Model& model) {
  std::vector<Row> rows;
  for (const Row& row : model.rows) {
    if (row.lower == row.upper) {
      rows.push_back(row);
      continue;
    }
    if (row.lower > -infinity) rows.push_back({row.lower, infinity, row.entries, row.name});
    if (row.upper < infinity) rows.push_back({-infinity, row.upper, row.entries, row.name});
  }
  return rows;
}

void expect_same(double read, double written, std::string_view backend) {
  if (backend == "highs" || !std::isfinite(written))
    EXPECT_EQ(read, written);
  else  // CBC's reader parses numbers itself and loses the last bits
    EXPECT_NEAR(read, written, 1e-15 * std::abs(written));
}

TEST(ModelFile, EverySolverReadsItBackUnchanged) {
  const test::TempFolder folder;
  const Model model = awkward();
  const auto rows = in_file(model);
  for (const Format& format : formats) {
    format.write(model, folder / format.file);
    for (const Backend& backend : backends()) {
      SCOPED_TRACE(std::string(backend.name) + " " + format.file);
      const Model read = backend.read(folder / format.file);
      ASSERT_EQ(read.columns.size(), model.columns.size());
      ASSERT_EQ(read.rows.size(), rows.size());
      std::set<std::string> names;
      for (std::size_t j = 0; j < read.columns.size(); ++j) {
        SCOPED_TRACE(j);
        expect_same(read.columns[j].cost, model.columns[j].cost, backend.name);
        EXPECT_EQ(read.columns[j].lower, model.columns[j].lower);
        EXPECT_EQ(read.columns[j].upper, model.columns[j].upper);
        EXPECT_EQ(read.columns[j].integer, model.columns[j].integer);
        EXPECT_TRUE(names.insert(read.columns[j].name).second) << read.columns[j].name;
      }
      EXPECT_EQ(read.columns[0].name, "G1_0_0");
      for (std::size_t i = 0; i < rows.size(); ++i) {
        SCOPED_TRACE(i);
        expect_same(read.rows[i].lower, rows[i].lower, backend.name);
        expect_same(read.rows[i].upper, rows[i].upper, backend.name);
        std::size_t k = 0;
        for (const Entry& entry : read.rows[i].entries) {
          if (entry.value == 0) continue;
          ASSERT_LT(k, rows[i].entries.size());
          EXPECT_EQ(entry.column, rows[i].entries[k].column);
          expect_same(entry.value, rows[i].entries[k].value, backend.name);
          ++k;
        }
        EXPECT_EQ(k, rows[i].entries.size());
        EXPECT_TRUE(names.insert(read.rows[i].name).second) << read.rows[i].name;
      }
      EXPECT_EQ(read.rows[0].name, "A1_front_1_3");
    }
  }
}

TEST(ModelFile, WritesModelsWithoutColumns) {
  const test::TempFolder folder;
  Model model;
  model.rows.push_back({1.0, infinity, {}, "label"});
  for (const Format& format : formats) {
    format.write(model, folder / format.file);
    for (const Backend& backend : backends())
      EXPECT_EQ(backend.solve(backend.read(folder / format.file), {}, {}).termination,
                Termination::infeasible)
          << format.file << backend.name;
  }
}

TEST(ModelFile, LeavesNothingBehindWhenItCannotWrite) {
  const test::TempFolder folder;
  for (const Format& format : formats)
    test::expect_input_error([&] { format.write(awkward(), folder / "no such folder" / format.file); },
                             "no such folder");
  EXPECT_EQ(folder.count(), 0);
}

TEST(ModelFile, ReadersRejectInvalidModels) {
  const test::TempFolder folder;
  folder.write("bad.mps", "this is no model\n");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  for (const Backend& backend : backends())
    test::expect_input_error([&] { backend.read(folder / "bad.mps"); }, "bad.mps");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ModelFile, BreaksLongLines) {
  const test::TempFolder folder;
  std::vector<std::uint32_t> all(500);
  for (std::uint32_t j = 0; j < all.size(); ++j) all[j] = j;
  write_lp(test::cover(all.size(), {all}), folder / "long.lp");
  const std::string text = read_file(folder / "long.lp");
  for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    ASSERT_LE(end - begin, 200U);
  }
  for (const Backend& backend : backends())
    EXPECT_EQ(backend.read(folder / "long.lp").rows.at(0).entries.size(), all.size());
}

}  // namespace
}  // namespace shelfbeam::milp
