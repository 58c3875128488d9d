#include "shelfbeam/material/material.hpp"

#include "support/testing.hpp"
#include "unit/material/cases.hpp"

namespace shelfbeam::test {
namespace {

/// A row of a table of docs/methods/materials.md that begins with the name of a material.
struct Row {
  std::string material;
  double roughness = 0;
  std::vector<double> albedos;  // at `angles`
};

const std::vector<double> angles{0, 45, 60, 75, 85};

std::vector<Row> documented_rows() {
  std::ifstream file(SHELFBEAM_SOURCE_DIR "/docs/methods/materials.md");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    Row row;
    std::istringstream cells(line);
    std::string cell;
    std::vector<std::string> texts;
    while (std::getline(cells, cell, '|')) texts.push_back(cell);
    if (texts.size() != 8 || texts[1].find("albedo of ") == std::string::npos) continue;
    row.material = texts[1].substr(texts[1].find("albedo of ") + 10);
    row.material.erase(row.material.find_last_not_of(' ') + 1);
    row.roughness = std::stod(texts[2]);
    for (std::size_t k = 3; k < 8; ++k) row.albedos.push_back(std::stod(texts[k]));
    rows.push_back(row);
  }
  return rows;
}

double computed(const Row& row, double angle) {
  using enum FacetDistribution;
  const auto ggx_facets = make_microfacets(ggx, row.roughness, row.roughness);
  const auto beckmann_facets = make_microfacets(beckmann, row.roughness, row.roughness);
  const Vec3 w = direction_at(angle);
  if (row.material == "ideal metal, ggx") return albedo(make_conductor(0, 1, ggx_facets), w);
  if (row.material == "ideal metal, beckmann") return albedo(make_conductor(0, 1, beckmann_facets), w);
  if (row.material == "glass from outside, ggx") return albedo(make_dielectric(1.5, ggx_facets), w);
  if (row.material == "glass from inside, ggx") return albedo(make_dielectric(1.5, ggx_facets), -w);
  if (row.material == "plastic of base 0.5, ggx") return albedo(make_plastic(1.5, 0.5, ggx_facets), w);
  ADD_FAILURE() << "what is '" << row.material << "'?";
  return 0;
}

// The manual's tables agree with the program within half a unit of the last digit and the quadrature's error.
// The control takes the albedos of the next roughness.
TEST(Documentation, AlbedosAreThoseOfTheProgram) {
  const auto rows = documented_rows();
  ASSERT_GE(rows.size(), 20U);
  int differ = 0;
  for (const Row& row : rows)
    for (std::size_t k = 0; k < angles.size(); ++k) {
      const double error = row.material.starts_with("glass") ? 2.5e-3 : 7e-4;
      EXPECT_NEAR(row.albedos[k], computed(row, angles[k]), error)
          << row.material << " " << row.roughness << " at " << angles[k];
      if (angles[k] != 60) continue;
      Row other = row;
      other.roughness = std::min(1.0, 1.5 * row.roughness);
      differ += std::abs(row.albedos[k] - computed(other, angles[k])) > error;
    }
  EXPECT_GT(differ, 10);
}

}  // namespace
}  // namespace shelfbeam::test
