#include "shelfbeam/report/viewer/page_data.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/report/page_reader.hpp"

namespace shelfbeam {
namespace {

using test::PageReader;

TEST(PageData, IsReadBackUnchanged) {
  PageData page;
  const std::vector<std::uint8_t> bytes{0, 1, 255};
  const std::vector<std::uint16_t> words{0, 65535, 258};
  const std::vector<std::uint32_t> numbers{4294967295U, 66051};
  const std::vector<float> floats{0.1F, -1e-30F, INFINITY};
  const std::vector<double> doubles{0.1, -1e-300, 3};
  page.add("bytes", bytes);
  page.add("words", words);
  page.add("numbers", numbers);
  page.add("none", std::vector<float>());
  page.add("floats", floats);
  page.add("doubles", doubles);
  const std::string text = page.base64(R"({"name":"Käse & <b>"})");
  const PageReader reader(text);
  EXPECT_EQ(reader.about["name"], "Käse & <b>");
  EXPECT_EQ(reader.get<std::uint8_t>("bytes"), bytes);
  EXPECT_EQ(reader.get<std::uint16_t>("words"), words);
  EXPECT_EQ(reader.get<std::uint32_t>("numbers"), numbers);
  EXPECT_EQ(reader.get<float>("none"), std::vector<float>());
  EXPECT_EQ(reader.get<float>("floats"), floats);
  EXPECT_EQ(reader.get<double>("doubles"), doubles);
  // Negative control: the reader detects damage.
  std::string damaged = text;
  damaged[damaged.size() / 2] = damaged[damaged.size() / 2] == 'A' ? 'B' : 'A';
  EXPECT_ANY_THROW(PageReader{damaged});
  EXPECT_ANY_THROW(PageReader{text.substr(0, text.size() - 8)});
}

}  // namespace
}  // namespace shelfbeam
