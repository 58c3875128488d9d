#include "shelfbeam/base/error.hpp"

#include "support/line_ends.hpp"
#include "support/testing.hpp"
#include "unit/device/photometry_files.hpp"

namespace shelfbeam::test {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  if (at == std::string::npos) ADD_FAILURE() << "'" << from << "' is not in the text";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void expect_same(const DirectionTable& a, const DirectionTable& b, const std::string& what) {
  EXPECT_EQ(a.theta(), b.theta()) << what;
  EXPECT_EQ(a.phi(), b.phi()) << what;
  EXPECT_EQ(a.values(), b.values()) << what;
}

TEST(PhotometryTorture, LineEndsByteOrderMarksAndBlanksDoNotMatter) {
  for (const auto& file : corpus()) {
    const bool ies = is_ies(file);
    const std::string text = read_file(file), name = file.filename().string();
    const DirectionTable expected = parse_photometry(ies, text, name);
    const auto check = [&](const std::string& variant, const std::string& what) {
      expect_same(parse_photometry(ies, variant, name), expected, fmt::format("{} {}", name, what));
    };
    check(with_line_ends(text, "\r\n"), "CR LF");
    check(with_line_ends(text, "\r"), "CR");
    check(with_line_ends(text, " \t\n"), "trailing blanks");
    check("\xEF\xBB\xBF" + text, "byte order mark");
    check(text + "\n\n  \n", "blank lines at the end");
    check(text + "END\r\n", "END");
    check(text + "\x1A", "control-Z");
    check(text.substr(0, text.size() - 1), "last line without an end");
  }
}

// The file with its numbers in lines of `count` words.
std::string reflowed(const std::string& text, std::size_t count) {
  const std::size_t data = text.find('\n', text.find("TILT=")) + 1;
  std::string result = text.substr(0, data);
  std::istringstream words(text.substr(data));
  std::size_t k = 0;
  for (std::string word; words >> word; ++k) result += word + (k % count == count - 1 ? "\n" : " ");
  return result;
}

TEST(PhotometryTorture, LineBreaksBetweenNumbersDoNotMatterInIes) {
  std::size_t files = 0;
  for (const auto& file : corpus()) {
    if (!is_ies(file)) continue;
    ++files;
    const std::string text = read_file(file), name = file.filename().string();
    const DirectionTable expected = parse_photometry(true, text, name);
    for (const std::size_t count : {1U, 3U, 7U, 1000U})
      expect_same(parse_photometry(true, reflowed(text, count), name), expected,
                  fmt::format("{} in lines of {}", name, count));
    std::string pages = reflowed(text, 7);
    pages.insert(pages.find('\n', pages.find("TILT=")) + 1, "\f\v");
    expect_same(parse_photometry(true, pages, name), expected, name + " with a form feed");
    // A number too many or too few is still an error, and names the first line that is suspicious.
    const std::string all = reflowed(text, 1000);
    expect_input_error([&] { parse_photometry(true, all + " 7", name); }, name, "'7'");
    expect_input_error(
        [&] { parse_photometry(true, all.substr(0, all.find_last_of(' ', all.size() - 3)), name); }, name,
        "truncated");
  }
  EXPECT_GT(files, 5U);
}

TEST(PhotometryTorture, EulumdatMayBeginAt90Degrees) {
  const std::string text = read_file(SHELFBEAM_SOURCE_DIR "/test/data/field/uplight.ldt");
  const DirectionTable table = parse_eulumdat(text, "a");
  EXPECT_NEAR(table.theta().front(), radians(90), 1e-12);
  EXPECT_NEAR(table.theta().back(), radians(180), 1e-12);
  expect_input_error([&] { parse_eulumdat(replaced(text, "\n90\n120", "\n80\n120"), "a"); },
                     "gamma angle is 80", "0 or 90");
}

TEST(PhotometryTorture, WideTextsAreNamed) {
  for (const auto& file : corpus()) {
    const std::string wide = in_utf16(read_file(file));
    expect_input_error([&] { parse_photometry(is_ies(file), wide, "a"); }, "a: is UTF-16");
  }
}

// Every line of a file is required, including the last.
TEST(PhotometryTorture, TruncationAtAnyLineIsOneClearError) {
  for (const auto& file : corpus()) {
    const std::string text = read_file(file), name = file.filename().string();
    for (std::size_t end = text.rfind('\n', text.size() - 2); end != std::string::npos;
         end = end == 0 ? std::string::npos : text.rfind('\n', end - 1)) {
      const std::string message =
          input_error([&] { parse_photometry(is_ies(file), text.substr(0, end), name); });
      EXPECT_TRUE(message.starts_with(name)) << message;
      EXPECT_TRUE(message.find("truncated") != std::string::npos ||
                  message.find("more than") != std::string::npos)
          << name << " up to character " << end << ": " << message;
    }
    EXPECT_FALSE(input_error([&] { parse_photometry(is_ies(file), "", name); }).empty());
  }
}

struct Mistake {
  std::string file, from, to;
  std::vector<std::string> said;
};

// Each error is made in a file that is valid otherwise (the tests above read them all).
TEST(PhotometryTorture, MistakesAreNamedWithTheirLine) {
  const std::string quadrant = "1991_quadrant_tilt.ies", full = "2019_full_sphere.ies",
                    floodlight = "b_full.ies", half = "symmetry_2_24_planes.ldt", open = "symmetry_0.ldt",
                    three = "symmetry_3.ldt";
  const std::vector<Mistake> mistakes{
      {quadrant, "4 3 1 2", "4 3 3 2", {"line 9", "type A"}},
      {quadrant, "4 3 1 2", "4 3 4 2", {"line 9", "photometric type is 4"}},
      {quadrant, "4 3 1 2", "4 3 1 3", {"line 9", "type of units"}},
      {quadrant, "4 3 1 2", "4000000000 3 1 2", {"line 9", "vertical angles is 4000000000"}},
      {quadrant, "4 3 1 2", "100 100 1 2", {"line 9", "100 x 100"}},
      {quadrant, "4 3 1 2", "1 3 1 2", {"line 9", "vertical angle"}},
      {quadrant, "4 3 1 2", "4 0 1 2", {"line 9", "horizontal angles is 0"}},
      {quadrant, "4 3 1 2", "4 2.5 1 2", {"line 9", "2.5"}},
      {quadrant, "4 3 1 2", "3 3 1 2", {"line 11", "vertical angles"}},
      {quadrant, "4 3 1 2", "4 2 1 2", {"line 12", "horizontal angles"}},
      {quadrant, "1 1000 1 4", "1 1000,5 1,0 4", {"line 9", "lamp data"}},
      {quadrant, "1 1000 1 4", "1 1000 0 4", {"multiplier 0"}},
      {quadrant, "1 1 40", "-1 1 40", {"line 10", "ballast"}},
      {quadrant, "1 1 40", "0.1e308 1 40", {"line 13", "an intensity is 1e+308"}},
      {quadrant, "1 1 40", "1 1", {"line 11", "ballast data"}},
      {quadrant, "0 30 60 90", "0 30 90 60", {"line 11", "60 follows 90"}},
      {quadrant, "0 30 60 90", "0 30 60 80", {"line 11", "from 0 to 80", "0 to 90"}},
      {quadrant, "0 30 60 90", "-90 0 60 90", {"line 11", "from -90 to 90"}},
      {quadrant, "\n0 45 90\n10", "\n0 45 80\n10", {"line 12", "from 0 to 80"}},
      {quadrant, "\n0 45 90\n10", "\n30 45 90\n10", {"line 12", "from 30 to 90"}},
      {quadrant, "20 21", "20 -21", {"line 14", "-21"}},
      {quadrant, "20 21", "20 2l", {"line 14", "'2l'", "horizontal angle 45"}},
      {quadrant, "20 21", "20 nan", {"line 14", "'nan'"}},
      {quadrant, "20 21", "20,5 21", {"line 14", "horizontal angle 45"}},
      {quadrant, "33", "33\n40 41 42 43", {"line 16", "40 41 42 43"}},
      {quadrant, "TILT=INCLUDE", "TILT=NONE", {"line 9", "lamp data"}},
      {quadrant, "TILT=INCLUDE\n1", "TILT=INCLUDE\n4", {"line 5", "lamp-to-luminaire"}},
      {quadrant, "\n3\n0 45 90", "\n900000000\n0 45 90", {"line 6", "tilt angles is 900000000"}},
      {quadrant, "\n3\n0 45 90", "\n3\n0 90 45", {"line 7", "tilt angles"}},
      {quadrant, "IESNA91", "IESNA:LM-63-2031", {"line 1", "2031"}},
      {full, "0 90 180 270 360", "0 90 180 270 340", {}},  // the gap to 360 is no wider than a step
      {full, "0 90 180 270 360", "0 20 40 60 250", {}},
      {full, "0 90 180 270 360", "0 60 120 150 181", {"line 8", "from 0 to 181"}},
      {full, "0 90 180 270 360", "0 90 180 270 365", {"line 8", "from 0 to 365"}},
      {"upwards.ies", "\n0\n", "\n5\n", {"line 6", "from 5 to 5"}},
      {"upwards.ies", "10 11 12 13", "0 0 0 0", {"emits nothing"}},
      {floodlight, "-90 -45 0 45 90", "-80 -45 0 45 90", {"line 6", "from -80 to 90", "type B"}},

      {half, "corpus", "corpus\nline", {"line"}},
      {half, "\n24\n", "\n25\n", {"C-angle 0 follows 345"}},
      {half, "\n24\n", "\n2400000000\n", {"line 4", "C-planes is 2400000000"}},
      {half, "\n15\n4\n", "\n15\n1\n", {"gamma angle"}},
      {half, "\n2\n24", "\n5\n24", {"line 3", "symmetry is 5"}},
      {half, "\n2\n24", "\n0\n24", {"line 3", "all 24 C-planes", "those of 13"}},
      {half, "\n2\n24", "\n4\n24", {"line 3", "7 of the 24", "those of 13"}},
      {half, "\n180\n", "\n181\n", {"C-plane at 180"}},
      {half, "\n13\n20", "\n-13\n20", {"-13"}},
      {half, "\n13\n20", "\n1.3.0\n20", {"'1.3.0'", "C-plane 0"}},
      {half, "\n13\n20", "\n\n20", {"''"}},
      {half, "80.5\n1\n", "80.5\n1e30\n", {"an intensity is 1"}},
      {half, "80.5\n1\n", "80.5\n0\n", {"line 24", "conversion factor is 0"}},
      {half, "80.5\n1\n0\n1\n", "80.5\n1\n0\n1000000000\n", {"line 26", "sets of lamps is 1000000000"}},
      {open, "\n315\n", "\n365\n", {"C-angle is 365"}},
      {open, "0\n45\n90\n135\n180\n225\n270\n315", "0\n5\n10\n15\n20\n25\n30\n35", {"C-angles end at 35"}},
      {three, "\n270\n", "\n271\n", {"C-plane at 270"}},
  };
  for (const Mistake& mistake : mistakes) {
    const auto file = corpus_folder / mistake.file;
    const std::string text = replaced(read_file(file), mistake.from, mistake.to);
    const auto parse = [&] { parse_photometry(is_ies(file), text, mistake.file); };
    if (mistake.said.empty()) {
      EXPECT_NO_THROW(parse()) << mistake.to;
      continue;
    }
    const std::string message = input_error(parse);
    EXPECT_TRUE(message.starts_with(mistake.file + ":")) << message;
    for (const std::string& part : mistake.said)
      EXPECT_NE(message.find(part), std::string::npos)
          << mistake.to << ": '" << part << "' is not in: " << message;
  }
}

TEST(PhotometryTorture, TheOtherFormatIsRecognised) {
  expect_input_error([] { read_ies(corpus_folder / "symmetry_0.ldt"); }, "TILT", "eulumdat");
  expect_input_error([] { read_eulumdat(corpus_folder / "b_full.ies"); }, "b_full.ies: line 3", "symmetry");
  expect_input_error([] { read_ies(corpus_folder / "none.ies"); }, "none.ies");
}

}  // namespace
}  // namespace shelfbeam::test
