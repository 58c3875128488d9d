#include "support/testing.hpp"
#include "unit/scene/mesh_files.hpp"

namespace shelfbeam::test {
namespace {

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

// Removes a line of the second facet. Its first line is line 9 of the file.
std::string without(const std::string& line) {
  std::string broken = facet;
  broken.erase(broken.find(line), line.size());
  return "solid a\n" + facet + broken + facet + "endsolid a\n";
}

void expect_refused(const std::string& text, const std::string& line, const std::string& problem) {
  expect_input_error([&] { read_mesh("a.stl", text); }, "store.json: fixtures[0].file: ", line, problem);
}

TEST(Stl, OpenAndShortFacetsAreRefusedWithTheirLine) {
  expect_refused(without("endfacet\n"), "line 15 of '", "the facet that begins in line 9 has no 'endfacet'");
  expect_refused(without("endloop\n"), "line 14 of '", "the facet that begins in line 9 has no 'endloop'");
  expect_refused(without("endloop\nendfacet\n"), "line 14 of '", "begins in line 9");
  expect_refused(without("vertex 2 0 0\n"), "line 13 of '", "begins in line 9 has 2 vertices");
  expect_refused(without("outer loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 1 0\nendloop\n"), "line 10 of '",
                 "begins in line 9 has no vertices");
  expect_refused(without("outer loop\n"), "line 10 of '", "outside 'outer loop'");
  expect_refused(without("facet normal 0 0 1\n"), "line 13 of '", "ends no loop of a facet");
  std::string joined = facet + facet;
  const std::string between = "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\n";
  joined.erase(joined.find(between), between.size());
  expect_refused("solid\n" + joined + "endsolid\n", "line 7 of '", "more than three vertices");
}

TEST(Stl, LargeFacetsAndLooseVerticesAreRefused) {
  std::string large = facet;
  large.insert(large.find("endloop"), "vertex 0 0 1\n");
  expect_refused("solid\n" + large + "endsolid\n", "line 7 of '",
                 "begins in line 2 has more than three vertices");
  expect_refused("solid\nvertex 0 0 0\n" + facet + "endsolid\n", "line 2 of '", "outside 'outer loop'");
  expect_refused("solid\n" + facet + "endfacet\nendsolid\n", "line 9 of '", "ends no facet");
}

TEST(Stl, CoordinatesMayNotBeMissing) {
  std::string broken = facet;
  broken.replace(broken.find("2 0 0"), 5, "2 0");
  expect_refused("solid\n" + broken + "endsolid\n", "line 6 of '",
                 "the vertex in line 5 has fewer than three");
  broken.replace(broken.find("2 0"), 3, "2 x 0");
  expect_refused("solid\n" + broken + "endsolid\n", "line 5 of '", "'x' is not a finite number");
}

TEST(Stl, NamesMayHaveAnyBytes) {
  EXPECT_DOUBLE_EQ(mesh_area(read_mesh("a.stl", std::string("solid a\0b\xFF\n", 11) + facet + "endsolid\n")),
                   1);
}

TEST(Stl, EndsAfterItsLastFacet) {
  const std::string open = facet.substr(0, facet.find("endloop"));
  expect_refused("solid a\n" + facet + open, "", "ends within the facet that begins in line 9");
  expect_refused("solid a\n" + facet + open + "endsolid a\n", "line 14 of '", "before endsolid");
  expect_refused("solid a\n" + facet + open + "solid b\n", "line 14 of '", "before solid");
  expect_refused("solid a\n" + facet, "", "before 'endsolid'");
}

TEST(Stl, LinesHaveNoMeaning) {
  std::string one_line = "solid a vertex of facet\n" + facet + facet;
  for (std::size_t k = one_line.find('\n') + 1; k < one_line.size(); ++k)
    if (one_line[k] == '\n') one_line[k] = ' ';
  EXPECT_DOUBLE_EQ(
      mesh_area(read_mesh("a.stl", one_line + "\nENDSOLID a facet\nSolid b\n" + facet + "endsolid")), 3);
}

std::string binary(std::size_t count, std::size_t facets, std::uint16_t attribute = 0, std::size_t data = 0) {
  std::string bytes = "solid b";
  bytes.resize(80, ' ');
  bytes += bytes_of(static_cast<std::uint32_t>(count));
  for (std::size_t k = 0; k < facets; ++k)
    bytes += bytes_of(std::array<float, 12>{0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 1, 0}) + bytes_of(attribute) +
             std::string(data, '\x7F');
  return bytes;
}

std::vector<std::string> warnings(const std::string& bytes, double area) {
  const Scene scene = read_mesh("a.stl", bytes);
  EXPECT_DOUBLE_EQ(mesh_area(scene), area);
  return file_warnings(scene);
}

TEST(Stl, BinaryFacetsMayCarryColoursAndData) {
  EXPECT_TRUE(warnings(binary(3, 3), 3).empty());
  EXPECT_TRUE(warnings(binary(3, 3, 0x7FFF), 3).empty()) << "a colour";
  EXPECT_TRUE(warnings(binary(3, 3, 4, 4), 3).empty());
  EXPECT_TRUE(warnings(binary(3, 3, 50, 50), 3).empty()) << "as long as a facet";
}

TEST(Stl, BinaryCountsThatDoNotFit) {
  const auto note = [](const std::string& bytes, double area) {
    const auto found = warnings(bytes, area);
    return found.size() == 1 ? found[0] : fmt::format("{} warnings", found.size());
  };
  EXPECT_EQ(note(binary(3, 3) + std::string(16, 'x'), 3),
            "store.json: fixtures[0]: the mesh 'a.stl' has 16 bytes behind its facets, which were ignored");
  EXPECT_EQ(
      note(binary(0, 3), 3),
      "store.json: fixtures[0]: the mesh 'a.stl' states no facets in its header, but contains 3, which were "
      "read");
  expect_refused(binary(3, 4), "", "states 3 facets in its header, but is long enough for 4");
  expect_refused(binary(0, 3) + "x", "", "states 0 facets in its header, but is long enough for 3");
  expect_refused(binary(4, 3), "", "ends before the last facet that its binary header counts");
  expect_refused(binary(3, 3).substr(0, 200), "", "ends before the last facet");
}

}  // namespace
}  // namespace shelfbeam::test
