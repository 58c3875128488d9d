#include "serve/project/project_file.hpp"

#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {
namespace {

std::string number(std::uint64_t value, int bytes, bool is_big) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> 8 * (is_big ? bytes - 1 - k : k) & 0xff);
  return text;
}

std::string png(std::uint64_t width, std::uint64_t height, std::string_view data = "data") {
  const auto chunk = [](std::string_view type, const std::string& content) {
    return number(content.size(), 4, true) + std::string(type) + content + "crc.";
  };
  const std::string bits(5, '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", number(width, 4, true) + number(height, 4, true) + bits) +
         chunk("IDAT", std::string(data)) + chunk("IEND", "");
}

std::string jpeg(std::uint64_t width, std::uint64_t height) {
  const auto segment = [](char code, const std::string& content) {
    return std::string("\xff") + code + number(content.size() + 2, 2, true) + content;
  };
  const std::string frame = "\x08" + number(height, 2, true) + number(width, 2, true) + "\x01";
  return "\xff\xd8" + segment('\xe0', "JFIF") + "\xff" + segment('\xc2', frame) + segment('\xda', "scan") +
         "data\xff\xd9";
}

std::string webp(const std::string& chunk) {
  return "RIFF" + number(chunk.size() + 4, 4, false) + "WEBP" + chunk;
}

std::string extended_webp(std::uint64_t width, std::uint64_t height) {
  return webp("VP8X" + number(10, 4, false) + std::string(4, '\0') + number(width - 1, 3, false) +
              number(height - 1, 3, false));
}

std::string lossless_webp(std::uint64_t width, std::uint64_t height) {
  return webp("VP8L" + number(5, 4, false) + "\x2f" + number((width - 1) | (height - 1) << 14, 4, false));
}

std::string lossy_webp(std::uint64_t width, std::uint64_t height) {
  return webp("VP8 " + number(10, 4, false) + "fra\x9d\x01\x2a" + number(width, 2, false) +
              number(height, 2, false));
}

/// Pictures of 640 x 480 pixels in every format and form, with their names.
std::vector<std::pair<std::string, std::string>> pictures() {
  return {{"a.png", png(640, 480)},
          {"b.jpg", jpeg(640, 480)},
          {"c.JPEG", jpeg(640, 480)},
          {"d.webp", extended_webp(640, 480)},
          {"e.webp", lossless_webp(640, 480)},
          {"f.webp", lossy_webp(640, 480)}};
}

TEST(ProjectFile, HasItsSize) {
  const TempFolder folder;
  for (const auto& [name, content] : pictures()) {
    const ProjectFile kept = keep_file(folder.path(), name, content);
    EXPECT_EQ(kept.name, name);
    EXPECT_EQ(kept.width, 640U) << name;
    EXPECT_EQ(kept.height, 480U) << name;
    EXPECT_EQ(read_file(folder / name), content);
    EXPECT_EQ(stored_file(folder.path(), name)->content, content);
  }
  EXPECT_EQ(stored_file(folder.path(), "c.JPEG")->type, "image/jpeg");
}

TEST(ProjectFile, IsAPdf) {
  const TempFolder folder;
  const ProjectFile kept = keep_file(folder.path(), "plan.PDF", "%PDF-1.7 ...");
  EXPECT_EQ(kept.name, "plan.PDF");
  EXPECT_EQ(kept.width, 0U);
  EXPECT_EQ(stored_file(folder.path(), "plan.PDF")->type, "application/pdf");
  for (const std::string& before :
       {std::string("\xef\xbb\xbf"), std::string("Content-Type: application/pdf\r\n\r\n"),
        std::string(1024, '\n')}) {
    const ProjectFile late = keep_file(folder.path(), "late.pdf", before + "%PDF-1.7");
    EXPECT_EQ(stored_file(folder.path(), late.name)->type, "application/pdf");
  }
  EXPECT_THROW(keep_file(folder.path(), "later.pdf", std::string(1025, '\n') + "%PDF-1.7"), InputError);
  EXPECT_EQ(keep_file(folder.path(), "table.csv", "a,%PDF-\n").name, "table.csv");
}

TEST(ProjectFile, IsNoModelUnderTheNameOfATable) {
  const TempFolder folder;
  const auto refused = [&](const char* name, const std::string& content, std::string_view reason) {
    expect_input_error([&] { keep_file(folder.path(), name, content); }, reason);
  };
  const std::string model = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n";
  for (const char* name : {"plan.ifc", "plan.csv"})
    refused(name, model, "is a model (IFC or STEP); export the floor plan");
  refused("plan.dwg", "AC1032", "plan.dwg: is a DWG file; save it as DXF");
  refused("plan.dxf", "AutoCAD Binary DXF\r\n",
          "plan.dxf: is a binary DXF file; save it as DXF in text form");
  refused("table.csv", "PK\x03\x04", "table.csv: is a ZIP archive or a spreadsheet");
  refused("table.xls", "\xd0\xcf\x11\xe0", "table.xls: is a document or a spreadsheet");
  EXPECT_EQ(keep_file(folder.path(), "codes.csv", "AC1032,10\n").name, "codes.csv");
  EXPECT_TRUE(stored_file(folder.path(), "codes.csv"));
}

TEST(ProjectFile, IsADxf) {
  const TempFolder folder;
  for (const char* content : {"0\nSECTION\n", "  0\r\nSECTION\r\n",
                              "\xef\xbb\xbf"
                              "999\nmade by hand\n0\nSECTION\n"})
    EXPECT_NE(keep_file(folder.path(), "plan.dxf", content).name, "") << content;
  EXPECT_EQ(stored_file(folder.path(), "plan.dxf")->type, "image/vnd.dxf");
  for (const char* content : {"0", "00\nSECTION\n", "AutoCAD Binary DXF\r\n", "AC1032"})
    EXPECT_THROW(keep_file(folder.path(), "plan.dxf", content), InputError) << content;
  EXPECT_THROW(keep_file(folder.path(), "plan.dxf", std::string("0\n\0", 3)), InputError);
}

TEST(ProjectFile, IsACsvFile) {
  const TempFolder folder;
  const std::string table =
      "\xef\xbb\xbf"
      "article,description\r\n4001,\"Br\xc3\xb6tchen\t6\"\n";
  EXPECT_EQ(keep_file(folder.path(), "planogram.csv", table).name, "planogram.csv");
  EXPECT_EQ(read_file(folder / "planogram.csv"), table);
  EXPECT_EQ(stored_file(folder.path(), "planogram.csv")->type, "text/csv");
  EXPECT_EQ(stored_file(folder.path(), "planogram.csv")->content, table);
  EXPECT_EQ(keep_file(folder.path(), "planogram.csv", "other").name, "planogram-2.csv");
  EXPECT_EQ(read_file(folder / "planogram.csv"), table);
}

TEST(ProjectFile, NeverChangesUnderItsName) {
  const TempFolder folder;
  EXPECT_EQ(keep_file(folder.path(), "plan.png", png(1, 1, "one")).name, "plan.png");
  EXPECT_EQ(keep_file(folder.path(), "plan.png", png(1, 1, "one")).name, "plan.png");
  EXPECT_EQ(keep_file(folder.path(), "plan.png", png(1, 1, "two")).name, "plan-2.png");
  EXPECT_EQ(keep_file(folder.path(), "plan.png", png(1, 1, "two")).name, "plan-2.png");
  EXPECT_EQ(read_file(folder / "plan.png"), png(1, 1, "one"));
  std::filesystem::create_symlink("elsewhere.png", folder / "link.png");
  EXPECT_EQ(keep_file(folder.path(), "link.png", png(1, 1)).name, "link-2.png");
  EXPECT_FALSE(std::filesystem::exists(folder / "elsewhere.png"));
}

TEST(ProjectFile, IsRefusedWithTheReason) {
  const TempFolder folder;
  const auto refused = [&](const char* name, const std::string& content, std::string_view reason) {
    expect_input_error([&] { keep_file(folder.path(), name, content); }, reason);
  };
  refused("plan.jpg", png(1, 1), "plan.jpg: is a PNG picture; rename it to plan.png");
  refused("plan.pdf", png(1, 1), "plan.pdf: is a PNG picture; rename it to plan.png");
  refused("plan.png", "%PDF-1.7", "plan.png: is a PDF file; rename it to plan.pdf");
  constexpr auto unknown = "is no file that the planner can use";
  refused("plan.png", "", unknown);
  refused("plan.png", "a,b", unknown);
  refused("store.json", "{}", unknown);
  refused("plan.csv", png(1, 1), "plan.csv: is a PNG picture; rename it to plan.png");
  for (const std::string& content : {std::string(), std::string("a,b\0", 4), std::string("a,\x1b[31m"),
                                     std::string("a,\x7f"), std::string("Br\xf6tchen,1")})
    refused("plan.csv", content, unknown);
  refused("plan.png", png(60'000, 60'000), "has 60000 x 60000 pixels; the maximum is 100 million pixels");
  refused("plan.webp", extended_webp(1 << 24, 1 << 24), "has 16777216 x 16777216 pixels");
  refused("plan.png", png(0, 5), "is incomplete or damaged");
  for (const char* name :
       {"../plan.png", "a/plan.png", ".png", ".hidden.png", "", "a b.png", "pl\xc3\xa4n.png"})
    refused(name, png(1, 1), "the name of the file: is not of letters");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// Of a lossy WEBP only the length of the file is known here; the browser decodes the rest.
TEST(ProjectFile, IsRefusedIfItIsIncomplete) {
  const TempFolder folder;
  for (const auto& [name, content] : pictures())
    for (std::size_t size = 0; size < content.size(); ++size)
      EXPECT_THROW(keep_file(folder.path(), name, content.substr(0, size)), InputError)
          << name << ": " << size;
}

TEST(ProjectFile, IsARegularFileOfTheFolder) {
  const TempFolder folder;
  folder.write("plan.png", png(1, 1));
  folder.write("plan.jpg", png(1, 1));
  folder.write("store.json", "{}");
  folder.write("binary.csv", std::string(3, '\0'));
  folder.write("inner/plan.png", png(1, 1));
  std::filesystem::create_symlink("plan.png", folder / "link.png");
  std::filesystem::create_directory(folder / "folder.png");
  EXPECT_TRUE(stored_file(folder.path(), "plan.png"));
  for (const char* name :
       {"plan.jpg", "store.json", "binary.csv", "inner/plan.png", "link.png", "folder.png", "other.png", ""})
    EXPECT_FALSE(stored_file(folder.path(), name)) << name;
}

}  // namespace
}  // namespace shelfbeam::serve
