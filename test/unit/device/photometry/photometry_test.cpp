#include "support/documentation.hpp"
#include "support/testing.hpp"
#include "unit/device/photometry_files.hpp"

namespace shelfbeam::test {
namespace {

struct Probe {
  double theta_deg, phi_deg, value;
};

// Such as "0 90 20; 180 0 14".
std::vector<Probe> probes_in(const std::string& text) {
  std::vector<Probe> probes;
  std::istringstream words(text);
  char separator = ';';
  for (Probe probe{}; words >> probe.theta_deg >> probe.phi_deg >> probe.value; words >> separator) {
    EXPECT_EQ(separator, ';') << text;
    probes.push_back(probe);
  }
  EXPECT_TRUE(words.eof()) << text;
  return probes;
}

// The intensities of the corpus are numbered: 10 (stored plane + 1) + vertical angle, both counted from 0.
// The value at an angle therefore identifies its plane. The expected values were derived by hand from the
// rules of the formats.
const std::map<std::string, std::string> cases{
    {"1986_axial.ies", "0 0 5; 30 123 5.5; 75 300 6.25; 90 10 6.5; 91 10 0"},  // factor 2 x 0.5 x 0.5
    {"1991_quadrant_tilt.ies",
     "30 0 11; 30 45 21; 60 90 32; 30 135 21; 30 180 11; 60 225 22; 60 270 32; 30 315 21; 15 22.5 15.5"},
    {"1995_bilateral_negative_sizes.ies",
     "60 0 12; 30 90 21; 30 180 31; 30 270 21; 30 225 26"},  // the 7 is not a factor in this format
    {"2002_90_to_270_absolute.ies",
     "30 0 31; 30 45 21; 30 90 11; 30 135 21; 30 180 31; 30 225 41; 30 270 51; 30 315 41; 30 360 31"},
    {"2002_90_to_270_without_180.ies",
     "30 0 26; 30 30 21; 30 90 11; 30 150 21; 30 180 26; 30 210 31; 30 270 41; 30 330 31; 30 345 28.5"},
    {"2019_full_sphere.ies", "0 90 20; 135 90 23; 180 0 14; 90 270 42; 90 315 27"},
    {"open_circle.ies", "30 90 21; 30 270 41; 30 315 26; 30 360 11"},
    {"upwards.ies", "0 0 0; 89 0 0; 90 0 10; 120 7 11; 180 0 13"},
    {"commas_and_wrapped_lines.ies", "15 45 21; 90 135 25; 45 90 33"},
    // Type B: +x is V = 90, +y is H = -90.
    {"b_full.ies", "0 0 32; 45 0 33; 45 180 31; 45 270 42; 45 90 22; 90 0 34"},
    {"b_half.ies", "0 0 12; 45 0 13; 45 180 11; 45 270 22; 45 90 22; 95 0 0"},
    {"b_quadrant.ies", "0 0 10; 45 0 11; 45 180 11; 45 270 20; 45 90 20; 90 0 12"},
    {"symmetry_0.ldt",
     "30 0 22; 30 45 42; 60 180 104; 30 315 162; 30 337.5 92; 30 360 22"},  // conversion factor 2
    {"symmetry_1.ldt", "0 0 10; 30 77 11; 90 200 13"},
    {"symmetry_2_24_planes.ldt", "30 15 21; 30 345 21; 30 90 71; 30 180 131; 30 270 71"},
    {"symmetry_3.ldt", "30 0 31; 30 45 41; 30 90 51; 30 135 41; 30 180 31; 30 225 21; 30 270 11; 30 315 21"},
    {"symmetry_4_24_planes.ldt", "30 0 11; 30 15 21; 30 90 71; 30 105 61; 30 165 21; 30 195 21; 30 345 21"},
    {"uneven_planes.ldt", "105 20 23; 105 160 23; 180 90 34; 15 340 21; 15 270 31"},
    {"comma_decimals.ldt", "30 45 10.5; 30 315 40.5"},
    {"no_lamps_single_plane.ldt", "30 5 11; 90 100 13"},
};

bool holds(const DirectionTable& table, const std::vector<Probe>& probes, double turn = 0) {
  return std::all_of(probes.begin(), probes.end(), [&](const Probe& p) {
    return std::abs(value_at(table, p.theta_deg, std::fmod(p.phi_deg + turn, 360)) - p.value) < 1e-9;
  });
}

// Tolerance 1e-9 for values around 30: converting degrees costs about 1e-13. Control: the same profile
// rotated by 90 degrees must not fit, unless it is symmetric about the axis.
TEST(Photometry, EverySymmetryIsUnfoldedToTheRightPlanes) {
  for (const auto& [file, text] : cases) {
    const std::vector<Probe> probes = probes_in(text);
    const DirectionTable table = read_photometry(corpus_folder / file);
    for (const Probe& p : probes)
      EXPECT_NEAR(value_at(table, p.theta_deg, p.phi_deg), p.value, 1e-9)
          << file << " at theta " << p.theta_deg << ", phi " << p.phi_deg;
    EXPECT_TRUE(holds(table, probes)) << file;
    EXPECT_EQ(holds(table, probes, 90), table.phi().size() == 1) << file;
  }
}

TEST(Photometry, TheWholeCorpusIsProbed) {
  std::set<std::string> probed, present;
  for (const auto& [file, text] : cases) probed.insert(file);
  for (const auto& file : corpus()) present.insert(file.filename().string());
  EXPECT_EQ(probed, present);
}

// An IES file gives cd, so the integral is the flux in lm, computed here by Simpson's rule to 1e-12.
TEST(Photometry, TheIntegralIsTheFluxOfTheFile) {
  double flux = 0;
  constexpr int steps = 3000;
  for (int k = 0; k <= steps; ++k) {
    const double theta = k * pi / 2 / steps;
    const double candela = (10 + theta / radians(30)) / 2;
    flux += (k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2) * candela * std::sin(theta);
  }
  flux *= 2 * pi * (pi / 2 / steps) / 3;
  const DirectionTable table = read_ies(corpus_folder / "1986_axial.ies");
  EXPECT_NEAR(table.integral() / flux, 1, 1e-10);
  EXPECT_NEAR(table.with_integral(0.25).integral(), 0.25, 1e-15);
  // Only the shape depends on the file: factors cancel.
  std::string text = read_file(corpus_folder / "1986_axial.ies");
  text.replace(text.find("1 1000 2"), 8, "3 -1 777");
  const DirectionTable scaled = parse_ies(text, "scaled");
  EXPECT_NEAR(scaled.integral() / flux, 777 / 2.0, 1e-7);
  EXPECT_NEAR(value_at(scaled.with_integral(2), 40, 0), value_at(table.with_integral(2), 40, 0), 1e-14);
}

// Both files of a profile contain the same digits; they differ by the rounding of degrees and factors, about
// 1e-13. Control: a rotation by one degree is detected.
TEST(Photometry, TheProjectsProfilesAreTheSameInBothFormats) {
  for (const std::string name : {"wide-ceiling", "narrow-aisle", "batwing"}) {
    const DirectionTable ies = read_ies(data_folder / (name + ".ies")).with_integral(1);
    const DirectionTable ldt = read_eulumdat(data_folder / (name + ".ldt")).with_integral(1);
    double worst = 0, turned = 0;
    for (int ring = 0; ring < 136; ++ring)
      for (int sector = 0; sector < 109; ++sector) {
        const double theta = 0.7 * ring, phi = 3.3 * sector;
        worst = std::max(worst, std::abs(value_at(ies, theta, phi) - value_at(ldt, theta, phi)));
        turned = std::max(turned, std::abs(value_at(ies, theta, phi) - value_at(ldt, theta, phi + 1)));
      }
    EXPECT_LT(worst, 1e-12) << name;
    EXPECT_EQ(turned > 1e-3, name != "wide-ceiling") << name;
  }
}

// The files state 1000 lm for 1000 lm of lamps. Rounded digits and steps of 5 degrees lose below 1 %.
TEST(Photometry, TheProjectsProfilesHaveTheFluxTheyClaim) {
  for (const std::string name : {"wide-ceiling", "narrow-aisle", "batwing"}) {
    EXPECT_NEAR(read_ies(data_folder / (name + ".ies")).integral(), 1000, 10) << name;
    EXPECT_NEAR(read_eulumdat(data_folder / (name + ".ldt")).integral(), 1000, 10) << name;
  }
}

TEST(Photometry, TheBatwingIsStrongerTowards90Degrees) {
  const DirectionTable batwing = read_eulumdat(data_folder / "batwing.ldt");
  EXPECT_GT(value_at(batwing, 45, 90), 1.5 * value_at(batwing, 45, 270));
  EXPECT_NEAR(value_at(batwing, 45, 20), value_at(batwing, 45, 160), 1e-12);
}

TEST(Photometry, TheExampleOfTheDocumentationIsRead) {
  const DirectionTable table = parse_ies(fenced_blocks("photometry.md", "ies").at(0), "example");
  EXPECT_NEAR(value_at(table, 60, 180), 100, 1e-9);
  EXPECT_NEAR(value_at(table, 60, 270), 20, 1e-9);
}

}  // namespace
}  // namespace shelfbeam::test
