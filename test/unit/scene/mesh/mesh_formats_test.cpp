#include "support/testing.hpp"
#include "unit/scene/mesh_files.hpp"

// Corners are small integers, which 32 bits represent exactly; areas are sums of a few of their products, to
// 1e-12.

namespace shelfbeam::test {
namespace {

// A mesh in each format.
std::vector<std::pair<std::string, std::string>> files(const Triangles& triangles) {
  return {{"ascii.stl", ascii_stl(triangles)},
          {"binary.stl", binary_stl(triangles)},
          {"ascii.ply", ply(triangles, false)},
          {"binary.ply", ply(triangles, true)},
          {"mesh.obj", obj(triangles)}};
}

TEST(MeshFormats, AllDescribeTheSameSolid) {
  for (const auto& [name, content] : files(tetrahedron())) {
    const Scene scene = read_mesh(name, content);
    EXPECT_EQ(scene.mesh.triangles.size(), 4u) << name;
    EXPECT_NEAR(mesh_area(scene), tetrahedron_area, 1e-12) << name;
    EXPECT_EQ(scene.lower, (Vec3{0, 0, 0})) << name;
    EXPECT_EQ(scene.upper, (Vec3{1, 2, 3})) << name << ": z is up";
    EXPECT_TRUE(scene.warnings.empty()) << name;
    EXPECT_NEAR(volume(scene.mesh), 1, 1e-12) << name << ": outside out";
  }
}

TEST(MeshFormats, WithoutMaterialsTakeTheStar) {
  for (const auto& [name, content] : files(tetrahedron())) {
    EXPECT_EQ(read_mesh(name, content, {{"paint", "tile"}, {"*", "steel"}}).parts.at(0).material.value, 2u)
        << name;
    const Json starless = {{"Default*", "steel"}, {"?", "tile"}};
    expect_input_error([&, &file = name, &text = content] { read_mesh(file, text, starless); },
                       "fixtures[0].file: ", name + "' ", "\"*\"");
  }
}

TEST(MeshFormats, NonFiniteTextsAreRefused) {
  const std::string good = "1.5";
  for (const std::string wrong :
       {"nan", "NaN", "-nan", "inf", "-Infinity", "1e999", "1,5", "x", "0x10", "1.5m"}) {
    const auto refused = [&](const std::string& name, const std::string& before, const std::string& after,
                             const std::string& line) {
      const auto read_with = [&](const std::string& number) {
        read_mesh(name, fmt::format("{}{}{}", before, number, after));
      };
      EXPECT_NO_THROW(read_with(good)) << name;
      expect_input_error([&] { read_with(wrong); }, "store.json: fixtures[0].file: " + line, name,
                         "'" + wrong + "'");
    };
    refused("a.obj", "# v x\nv 0 0 0\nv 1 0 0\nv 0 ", " 0 0.1 0.2 0.3\nvn 0 0 1\nf 1 2 3\n", "line 4 of '");
    refused("a.stl",
            "solid x\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\n  vertex 0 2\t",
            "\r\nendloop\nendfacet\nendsolid x\n", "line 7 of '");
    refused("a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property float quality\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 "
            "0 nan\n"
            "1 0 0 1\n0 1 ",
            " 1\n3 0 1 2\n", "line 13 of '");
  }
}

TEST(MeshFormats, CoordinatesMayNotBeMissing) {
  expect_input_error([] { read_mesh("a.obj", "v 0 0 0\nv 1 \xFF 0\nv 0 1 0\nf 1 2 3\n"); }, "line 2 of '",
                     "coordinate");
}

// A file truncated anywhere but within its last number or its last line's end must be rejected.
TEST(MeshFormats, CutFilesAreRefused) {
  const TempFolder folder;
  for (const auto& [name, content] : files(tetrahedron())) {
    const Json store = mesh_store(name);
    const bool is_binary = name.starts_with("binary");
    const std::size_t keep = is_binary ? content.size() : content.find_last_of(" \n", content.size() - 2);
    for (std::size_t length = 0; length < keep; ++length) {
      // An OBJ file does not give its number of faces.
      if (name == "mesh.obj" && length > content.find("\nf ")) break;
      folder.write(name, content.substr(0, length));
      expect_input_error([&] { scene_of(store, folder.path()); }, "store.json: fixtures[0].file: ");
    }
  }
}

TEST(MeshFormats, PlyHeadersAreNotTrusted) {
  const std::string good = ply(tetrahedron(), false), binary = ply(tetrahedron(), true);
  const auto refused = [](std::string text, const std::string& old, const std::string& wrong,
                          const std::string& message) {
    ASSERT_NE(text.find(old), std::string::npos) << old;
    text.replace(text.find(old), old.size(), wrong);
    expect_input_error([&] { read_mesh("a.ply", text); }, "store.json: fixtures[0].file: ", "a.ply'",
                       message);
  };
  for (const std::string& text : {good, binary}) {
    refused(text, "vertex 12", "vertex 4000000000", "");
    refused(text, "vertex 12", "vertex 1e300", "line 4 of '");
    refused(text, "vertex 12", "vertex -1", "line 4 of '");
    refused(text, "face 4", "face 4000000000", "last");
    refused(text, "face 4", "face 5", "last");
    refused(text, "property float x", "property real x", "line 6 of '");
    refused(text, "list uchar int", "list float int", "list");
    refused(text, "format ", "format my_", "'format'");
    refused(text, "ply\n", "", "'ply'");
  }
  refused(good, "\n3 0 1 2", "\n3 0 1 12", "vertex 12 of 12");
  refused(good, "\n3 0 1 2", "\n3 0 1 -1", "vertex -1 of 12");
  refused(good, "\n3 0 1 2", "\n3 0 1 0.5", "vertex 0.5 of 12");
  refused(good, "\n3 0 1 2", "\n-3 0 1 2", "value 1 ");
  refused(good, "\n3 0 1 2", "\n1e300 0 1 2", "value 1 ");
  refused(good, "\n3 0 1 2", "\n4 0 1 2", "value 5");
  const std::string face = bytes_of(std::uint8_t{3}) + bytes_of(std::int32_t{9});
  for (const std::int32_t wrong : {12, -1, 1'000'000'000})
    refused(binary, face, face.substr(0, 1) + bytes_of(wrong), fmt::format("vertex {} of 12", wrong));
  refused(binary, face, "\xFF" + face.substr(1), "");
}

TEST(MeshFormats, FoldersAndOtherFormatsAreRefused) {
  const TempFolder folder;
  folder.write("inner.obj/file", "");
  expect_input_error([&] { scene_of(mesh_store("inner.obj"), folder.path()); },
                     "store.json: fixtures[0].file: '", "inner.obj' ", "folder");
  for (const char* name : {"a.fbx", "a.dae", "a"})
    expect_input_error([&] { read_mesh(name, obj(tetrahedron())); },
                       "store.json: fixtures[0].file: ", std::string(name) + "'", ".gltf");
}

TEST(MeshFormats, NonFiniteBytesAreRefused) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), infinite, -infinite}) {
    Triangles triangles = tetrahedron();
    triangles[1][2][0] = wrong;  // the sixth vertex, if each triangle has its own
    for (const auto& [name, content] : files(triangles))
      if (name.starts_with("binary"))
        expect_input_error([&, &file = name, &bytes = content] { read_mesh(file, bytes); },
                           "store.json: fixtures[0].file: ", "vertex 5 ", name + "' ");
  }
}

TEST(MeshFormats, TrianglesWithoutAreaAreDropped) {
  Triangles triangles = tetrahedron();
  const Corner a{1, 2, 3}, b{4, 6, 3}, between{2.5, 4, 3};
  const Corner off{2.5F, 4, 3 + 2e-7F};  // off the line by one rounding
  triangles.push_back({a, a, a});
  triangles.push_back({a, b, a});
  triangles.push_back({a, b, between});
  triangles.push_back({a, b, off});
  for (const auto& [name, content] : files(triangles)) {
    const Scene scene = read_mesh(name, content);
    EXPECT_EQ(scene.mesh.triangles.size(), 4u) << name;
    EXPECT_NEAR(mesh_area(scene), tetrahedron_area, 1e-12);
    ASSERT_EQ(scene.warnings.size(), 1u) << name;
    EXPECT_EQ(scene.warnings[0].sentence,
              "store.json: fixtures[0]: mesh 'M': dropped 4 of 8 triangles of zero area");
  }
  // A needle of 5 m by 0.01 mm is not thin by rounding, so it stays.
  triangles = tetrahedron();
  triangles.push_back({a, b, Corner{2.5F, 4, 3 + 1e-5F}});
  for (const auto& [name, content] : files(triangles)) {
    EXPECT_TRUE(read_mesh(name, content).warnings.empty()) << name;
    EXPECT_EQ(read_mesh(name, content).mesh.triangles.size(), 5u) << name;
  }
  const std::string flat = obj({{a, b, between}});
  expect_input_error([&] { read_mesh("flat.obj", flat); }, "store.json: fixtures[0]: ", "'M'", "area");
}

TEST(MeshFormats, PartsAreCheckedLikeFiles) {
  Store store = read(changed_store("/fixtures/3/parts/0/faces/0", "[1, 1, 2]"));
  store.materials[0].material = make_dielectric(1.5);
  const auto warnings = sentences(make_scene(store).warnings);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("'white' is not closed"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("1 of 2 triangles"), std::string::npos) << warnings[1];
}

TEST(MeshFormats, ImplausibleSizes) {
  const auto scaled = [](double scale, bool with_room) {
    Json store = sample_store();
    store["fixtures"][3]["scale"] = scale;
    if (!with_room) store.erase("room");
    return [store] { return warnings_of(store); };
  };
  // The sample's mesh has a size of 1, its room of 8 m.
  expect_input_error(scaled(80, true), "store.json: fixtures[3]: ", "'M'", "80 m", "\"scale\": 0.001");
  const auto outside = scaled(79, true)();
  ASSERT_EQ(outside.size(), 1u);
  EXPECT_TRUE(outside[0].starts_with("store.json: fixtures[3]: fixture 'M' ")) << outside[0];
  EXPECT_TRUE(outside[0].ends_with("its 'scale'")) << outside[0];
  expect_input_error(scaled(0.0009, true), "fixtures[3]: ", "'M'", "0.0009 m", "'scale'");
  EXPECT_TRUE(scaled(0.001, true)().empty());
  const auto is_told_of = [&](double scale) {
    const auto warnings = scaled(scale, false)();
    return std::count_if(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.starts_with("store.json: fixtures[3]: mesh 'M' is 201 m across");
    });
  };
  EXPECT_EQ(is_told_of(201), 1);
  EXPECT_EQ(is_told_of(200), 0);
}

Triangles turned(Triangles triangles) {
  for (auto& [a, b, c] : triangles) std::swap(b, c);
  return triangles;
}

// The triangles in the store file, each second one in another part of the same material.
Json parts_store(const Triangles& triangles) {
  Json store = mesh_store("");
  Json& mesh = store["fixtures"][0];
  mesh.erase("file");
  mesh.erase("materials");
  for (std::size_t part = 0; part < 2; ++part) {
    Json json{{"name", "P"}, {"material", "white"}, {"vertices", Json::array()}, {"faces", Json::array()}};
    for (std::size_t t = part; t < triangles.size(); t += 2) {
      const std::size_t first = json["vertices"].size();
      for (const Corner& corner : triangles[t]) json["vertices"].push_back(corner);
      json["faces"].push_back({first, first + 1, first + 2});
    }
    mesh["parts"].push_back(std::move(json));
  }
  return store;
}

Triangles with(Triangles triangles, Triangles more, float factor, float shift) {
  for (auto triangle : more) {
    for (Corner& corner : triangle)
      for (float& x : corner) x = shift + factor * x;
    triangles.push_back(triangle);
  }
  return triangles;
}

struct GlassCase {
  const char* name;
  Triangles triangles;
  double given;  ///< volume before and after the repair
  double volume;
  std::string warning;
};

std::vector<GlassCase> glass_cases() {
  const Triangles whole = tetrahedron();
  Triangles open = whole, twisted = whole, strewn = whole, seamed = whole;
  open.pop_back();
  std::swap(twisted[0][0], twisted[0][1]);
  // One side consists of three triangles that meet in a point on its edge. The fourth, without area, closes
  // the seam.
  const Corner o{0, 0, 0}, x{1, 0, 0}, y{0, 2, 0}, middle{0.5, 0, 0};
  strewn.push_back({x, middle, o});
  seamed[0] = {o, y, middle};
  seamed.push_back({middle, y, x});
  const Triangles unseamed = seamed;
  seamed.push_back({o, middle, x});
  const Triangles hollow = with(whole, turned(whole), 0.5F, 0.1F);
  return {{"whole", whole, 1, 1, ""},
          {"turned", turned(whole), -1, 1, "is inside out"},
          {"open", open, 0, 0, "is not closed"},
          {"twisted", twisted, 1, 1, "1 of 4 triangles of"},
          {"hollow", hollow, 0.875, 0.875, ""},
          {"hollow and turned", turned(hollow), -0.875, 0.875, "inside out"},
          {"outwards in a bubble", with(whole, whole, 0.5F, 0.1F), 1.125, 0.875, "4 of 8 triangles of"},
          {"glass in a bubble", with(hollow, whole, 0.25F, 0.15F), 0.890625, 0.890625, ""},
          {"one of two turned", with(turned(whole), whole, 2, 5), 7, 9, "4 of 8 triangles of"},
          {"one of two open", with(open, turned(whole), 1, 5), -1, 1, "a part of the surface"},
          {"twice", with(whole, whole, 1, 0), 2, 1, "4 of 8 triangles of"},
          {"strewn", strewn, 1, 1, "dropped 1 of 5"},
          {"seamed", seamed, 1, 1, "dropped 1 of 6"},
          {"unseamed", unseamed, 1, 1, "is not closed"}};
}

// Refraction requires closed surfaces that face outwards: tests the resulting volume and the warnings.
TEST(MeshFormats, SolidGlassIsClosedAndFacesOutwards) {
  const TempFolder folder;
  for (const auto& [what, triangles, given, expected, warning] : glass_cases()) {
    auto contents = files(triangles);
    contents.emplace_back("parts", "");
    for (const auto& [name, content] : contents) {
      SCOPED_TRACE(std::string(what) + " " + name);
      folder.write(name, content);
      Store store = name == "parts" ? read(parts_store(triangles)) : read(mesh_store(name), folder.path());
      // A volume is that about the origin, which lies in the open side of "one of two open".
      EXPECT_NEAR(volume(make_scene(store).mesh), given, 1e-5) << "any other material is taken as it is";
      store.materials[0].material = make_dielectric(1.5);
      const Scene scene = make_scene(store);
      EXPECT_NEAR(volume(scene.mesh), expected, 1e-5);
      ASSERT_EQ(scene.warnings.empty(), warning.empty());
      if (!warning.empty() && name != "parts") {
        EXPECT_NE(scene.warnings[0].sentence.find(warning), std::string::npos) << scene.warnings[0].sentence;
      }
    }
  }
}

}  // namespace
}  // namespace shelfbeam::test
