#include "shelfbeam/device/picture.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

using namespace std::string_literals;

const std::string png = "\x89PNG\r\n\x1a\n\0\0"s;

TEST(Picture, IsADataUriOfItsKind) {
  EXPECT_EQ(picture_uri(png), "data:image/png;base64,iVBORw0KGgoAAA==");
  EXPECT_EQ(picture_uri("\xff\xd8\xff\xe0"), "data:image/jpeg;base64,/9j/4A==");
  EXPECT_EQ(picture_uri("<svg/>"), "data:image/svg+xml;base64,PHN2Zy8+");
  EXPECT_TRUE(picture_uri("\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- made -->\n<svg></svg>"));
  for (const std::string& other :
       {""s, "GIF89a"s, "%PDF"s, "<html></html>"s, "a <svg/>"s, "<svg/>\xff"s, "\x89PNG"s})
    EXPECT_EQ(picture_uri(other), std::nullopt) << other;
  EXPECT_TRUE(picture_uri(png + std::string(max_picture_file - png.size(), 'x')));
  EXPECT_EQ(picture_uri(png + std::string(max_picture_file - png.size() + 1, 'x')), std::nullopt);
}

TEST(Picture, IsReadBackAsWritten) {
  for (std::size_t more = 0; more < 4; ++more)
    EXPECT_TRUE(is_picture_uri(*picture_uri(png + std::string(more, 'x'))));
  EXPECT_TRUE(is_picture_uri(*picture_uri(png + std::string(max_picture_file - png.size(), 'x'))));
  for (const char* other :
       {"", "data:", "data:image/png;base64,", "data:image/png;base64,AAA", "data:image/png;base64,AA=A",
        "data:image/png;base64,A===", "data:text/html;base64,AAAA", "data:image/png;base64,AA\"A",
        "data:image/gif;base64,AAAA", "DATA:image/png;base64,AAAA"})
    EXPECT_FALSE(is_picture_uri(other)) << other;
  EXPECT_FALSE(is_picture_uri("data:image/png;base64," + std::string(700'000, 'A')));
}

}  // namespace
}  // namespace shelfbeam::test
