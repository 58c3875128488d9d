#include "app/batch/store_list.hpp"
#include "support/testing.hpp"

namespace shelfbeam::app {
namespace {

// Every sequence of up to three steps, among them those that files need.
std::vector<std::string> odd_names() {
  const std::vector<std::string> steps{"a",
                                       "a.json",
                                       "a.json_",
                                       "a.json__",
                                       "report.html",
                                       "report.html_",
                                       "store.json",
                                       std::string(255, 'n'),
                                       std::string(254, 'n') + "m"};
  std::vector<std::string> names = steps;
  for (std::size_t k = 0, end = names.size(), depth = 2; depth <= 3; ++depth) {
    for (; k < end; ++k)
      for (const std::string& step : steps) names.push_back(names[k] + "/" + step);
    end = names.size();
  }
  return names;
}

TEST(BatchNames, NoFileIsNeededTwiceOrAsAFolder) {
  std::map<std::string, std::string> files;
  for (const std::string& name : odd_names())
    EXPECT_TRUE(files.emplace(file_of_name(name, ".json").string(), name).second) << name;
  for (const auto& [file, name] : files)
    for (std::filesystem::path folder = std::filesystem::path(file).parent_path(); !folder.empty();
         folder = folder.parent_path())
      EXPECT_FALSE(files.contains(folder.string())) << name;
}

TEST(BatchNames, NoFolderIsNeededTwiceOrAsAFileOfAPlan) {
  std::map<std::string, std::string> folders;
  for (const std::string& name : odd_names())
    EXPECT_TRUE(folders.emplace(folder_of_name(name).string(), name).second) << name;
  for (const auto& [folder, name] : folders)
    for (const char* file : {"report.html", "store.json"})
      EXPECT_FALSE(folders.contains(folder + "/" + file)) << name;
}

TEST(BatchNames, OrdinaryNamesAreTheirPaths) {
  for (const char* name : {"a", "north/12", "north.12/b c", "-x", "caf\u00e9/\"q\""}) {
    EXPECT_EQ(file_of_name(name, ".json").string(), std::string(name) + ".json");
    EXPECT_EQ(folder_of_name(name).string(), name);
  }
}

TEST(BatchNames, StepsLeaveRoomForTemporaryFiles) {
  for (std::size_t size = 200; size <= 1000; ++size)
    for (const std::string& step : {std::string(size, 'x'), std::string(size - 1, 'x') + "\u00fc"})
      for (const std::filesystem::path& part : file_of_name(fmt::format("{0}/{0}", step), ".json"))
        EXPECT_LE((".." + part.string() + "shelfbeam-XXXXXX").size(),
                  255U + (part.extension() == ".json" ? 0 : 18));
}

}  // namespace
}  // namespace shelfbeam::app
