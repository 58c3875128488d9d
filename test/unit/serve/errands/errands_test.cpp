#include "serve/errands/errands.hpp"

#include <memory>

#include <zip.h>

#include "serve/errands/comparison.hpp"
#include "serve/project/archive.hpp"
#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {
namespace {

void add_plan(const TempFolder& folder, const std::string& name) {
  folder.write(name + "/placement.json", "{}");
  folder.write(name + "/signal.h5", "");
}

TEST(ComparisonCommand, NeedsAPlanAndAFileInTheFolder) {
  const TempFolder folder;
  folder.write("inner/measured.csv", "label,signal\n");
  folder.write("secret.csv", "label,signal\n");
  const fs::path inner = folder / "inner";
  const auto command = [&](const char* file) { return comparison_command(inner, file, false); };
  expect_input_error([&] { command("measured.csv"); }, "has no plan; run 'shelfbeam plan");
  // A plan behind links is none.
  add_plan(folder, "outer");
  fs::create_directory_symlink("../outer", inner / "linked");
  fs::create_directory(inner / "plan");
  fs::create_symlink("../../outer/signal.h5", inner / "plan" / "signal.h5");
  folder.write("inner/plan/placement.json", "{}");
  expect_input_error([&] { command("measured.csv"); }, "has no plan");
  add_plan(folder, "inner/real");
  expect_input_error([&] { command("../secret.csv"); }, "is missing in the folder");
  expect_input_error([&] { command("/etc/passwd"); }, "is missing in the folder");
  const ComparisonCommand known = command("measured.csv");
  EXPECT_EQ(known.names, (Json{{"plan", "real"}, {"output", "comparison"}}));
  EXPECT_THAT(known.words, testing::Contains("--placement"));
  fs::create_directory(inner / "comparison");
  EXPECT_EQ(comparison_command(inner, "measured.csv", true).names["output"], "comparison-2");
  EXPECT_THAT(comparison_command(inner, "measured.csv", true).words,
              testing::Not(testing::Contains("--placement")));
}

class ErrandsOfAProject : public testing::Test {
 protected:
  ErrandsOfAProject() { folder_.write("measured.csv", "label,signal\n"); }

  static LateReply reply_of(Errands& errands) {
    std::vector<LateReply> replies;
    EXPECT_TRUE(becomes_true([&] { return !(replies = errands.poll()).empty(); }));
    return replies.empty() ? LateReply{} : replies.front();
  }
  static Request request(const char* verb, int id) {
    return {7, {{"id", id}, {"do", verb}, {"file", "measured.csv"}, {"of_pairs", true}}};
  }

  TempFolder folder_;
  PlanRuns plans_{folder_.path(), "/bin/false"};
};

TEST_F(ErrandsOfAProject, SayWhyTheyFail) {
  add_plan(folder_, "plan");
  Errands errands(folder_.path(), "/bin/sh");  // which finds no script 'compare'
  EXPECT_TRUE(errands.begin(request("compare", 1), plans_));
  expect_input_error([&] { errands.begin(request("compare", 2), plans_); }, "is running already");
  const LateReply first = reply_of(errands);
  EXPECT_EQ(first.tab, 7U);
  EXPECT_EQ(first.message["id"], 1);
  EXPECT_THAT(first.message["error"]["message"].get<std::string>(), testing::HasSubstr("compare"));
  EXPECT_TRUE(errands.begin(request("compare", 3), plans_)) << "the next one";
  EXPECT_EQ(reply_of(errands).message["id"], 3);
}

TEST_F(ErrandsOfAProject, LeaveOtherRequestsAlone) {
  Errands errands(folder_.path(), "/bin/false");
  EXPECT_FALSE(errands.begin(request("details", 1), plans_));
  EXPECT_TRUE(errands.poll().empty());
  expect_input_error(
      [&] { errands.begin({7, {{"id", 1}, {"do", "difference"}, {"before", 1U}, {"after", 2U}}}, plans_); },
      "plan");
}

TEST_F(ErrandsOfAProject, LeaveNoArchive) {
  folder_.write(".shelfbeam/project.zip.a1B2c3", "of a program that was killed");
  {
    const Errands errands(folder_.path(), "/bin/false");
    EXPECT_FALSE(fs::exists(folder_ / ".shelfbeam" / "project.zip.a1B2c3"));
    EXPECT_FALSE(errands.document("archive"));
    folder_.write(".shelfbeam/project.zip", "PK");
    const auto archive = errands.document("archive");
    ASSERT_TRUE(archive);
    EXPECT_EQ(archive->type, "application/zip");
    EXPECT_EQ(*archive->bytes, "PK");
  }
  EXPECT_FALSE(fs::exists(folder_ / ".shelfbeam" / "project.zip"));
}

std::map<std::string, std::string> content_of(const fs::path& path) {
  std::map<std::string, std::string> files;
  int code = 0;
  const std::unique_ptr<zip_t, void (*)(zip_t*)> archive(
      zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code), zip_discard);
  if (!archive) return files;
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t k = 0; k < count; ++k) {
    const auto index = static_cast<zip_uint64_t>(k);
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive.get(), index, 0),
                                                                 zip_fclose);
    std::array<char, 1000> text{};
    const zip_int64_t size = zip_fread(file.get(), text.data(), text.size());
    files[zip_get_name(archive.get(), index, 0)] = std::string(text.data(), static_cast<std::size_t>(size));
  }
  return files;
}

TEST(Archive, HasTheFilesThatAnotherPlannerNeeds) {
  const TempFolder folder;
  folder.write("Müller/store.json", "{}");
  folder.write("Müller/till.glb", "glTF");
  folder.write("Müller/plan/report.html", "<!doctype html>");
  folder.write("Müller/plan/signal.h5", "HDF");
  folder.write("Müller/plan/signal.h5.checkpoint", "half");
  folder.write("Müller/.shelfbeam/history.jsonl", "[]");
  folder.write("secret", "secret");
  fs::create_symlink("../secret", folder / "Müller" / "link.csv");
  fs::create_directory_symlink("..", folder / "Müller" / "up");
  const fs::path zip = folder / "out.zip";
  const ArchiveSize size = write_archive(folder / "Müller", zip);
  EXPECT_EQ(content_of(zip),
            (std::map<std::string, std::string>{{"Müller/store.json", "{}"},
                                                {"Müller/till.glb", "glTF"},
                                                {"Müller/plan/report.html", "<!doctype html>"},
                                                {"Müller/plan/signal.h5", "HDF"}}));
  EXPECT_EQ(size.files, 4U);
  EXPECT_EQ(size.bytes, fs::file_size(zip));
  EXPECT_EQ(write_archive(folder / "Müller", zip).files, 4U) << "replaces the last one";
}

TEST(Archive, RefusesOtherFoldersAndPlaces) {
  const TempFolder folder;
  folder.write("empty/readme.txt", "");
  expect_input_error([&] { write_archive(folder / "empty", folder / "out.zip"); }, "has no store.json");
  EXPECT_FALSE(fs::exists(folder / "out.zip"));
  folder.write("shop/store.json", "{}");
  EXPECT_THROW(write_archive(folder / "shop", folder / "missing" / "out.zip"), OutputError);
}

}  // namespace
}  // namespace shelfbeam::serve
