#include "shelfbeam/signal/text_file.hpp"

#include <zlib.h>

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

std::filesystem::path zipped(const TempFolder& folder, const std::string& text) {
  std::filesystem::path path = folder / "matrix.csv.gz";
  const gzFile file = gzopen(path.c_str(), "wb9");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  return path;
}

// Plain and compressed files, of sizes just below and above each growth of the reader's buffer.
TEST(TextFile, OfAnySizeIsReadWhole) {
  const TempFolder folder;
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 131072u, 5'000'000u}) {
    std::string text(size, '1');
    if (size > 2) text[size / 2] = ',';
    EXPECT_EQ(detail::read_text_file(folder.write("matrix.csv", text)), text) << size;
    EXPECT_EQ(detail::read_text_file(zipped(folder, text)), text) << size;
  }
}

TEST(TextFile, UnpacksUpToTheLimit) {
  const TempFolder folder;
  const std::filesystem::path bomb = zipped(folder, std::string(8'000'000, '0'));
  ASSERT_LT(std::filesystem::file_size(bomb), 20'000u) << "of eight million characters";
  expect_input_error([&] { detail::read_text_file(bomb, 7'999'999); }, bomb.string(), "7,999,999 bytes");
  EXPECT_EQ(detail::read_text_file(bomb, 8'000'000).size(), 8'000'000u);
}

}  // namespace
}  // namespace shelfbeam::test
