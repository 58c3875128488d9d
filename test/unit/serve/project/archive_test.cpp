#include "serve/project/archive.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <zip.h>

#include "shelfbeam/base/error.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam::serve {
namespace {

namespace fs = std::filesystem;

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
  const test::TempFolder folder;
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
  const test::TempFolder folder;
  folder.write("empty/readme.txt", "");
  test::expect_input_error([&] { write_archive(folder / "empty", folder / "out.zip"); }, "has no store.json");
  EXPECT_FALSE(fs::exists(folder / "out.zip"));
  folder.write("shop/store.json", "{}");
  EXPECT_THROW(write_archive(folder / "shop", folder / "missing" / "out.zip"), OutputError);
}

}  // namespace
}  // namespace shelfbeam::serve
