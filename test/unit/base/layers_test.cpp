#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam {
namespace {

using test::Outcome;
using test::TempFolder;

Outcome check_layers(const std::filesystem::path& root) {
  return test::run({SHELFBEAM_SOURCE_DIR "/scripts/check/layers", root.string()});
}

TEST(Layers, OfThisRepositoryAreKept) {
  const Outcome outcome = check_layers(SHELFBEAM_SOURCE_DIR);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

class LayersOfATree : public testing::Test {
 protected:
  LayersOfATree() {
    tree.write("src/shelfbeam/math/vec3.hpp", "#include \"shelfbeam/base/error.hpp\"\n#include <cmath>\n");
    tree.write("src/shelfbeam/plan/plan.cpp", "#include \"shelfbeam/device/emission.hpp\"\n");
    tree.write("src/app/main.cpp", "#include \"shelfbeam/report/data/report.hpp\"\n");
    tree.write("src/serve/project/a.cpp", "#include \"serve/text/edit.hpp\"\n");
    tree.write("test/unit/scene/a_test.cpp", "#include \"shelfbeam/scene/mesh/gltf_file.hpp\"\n");
    tree.write("test/physics/a_test.cpp", "#include \"shelfbeam/transport/reuse/reuse.hpp\"\n");
  }
  void expect_refused(const std::string& message) {
    const Outcome outcome = check_layers(tree.path());
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_THAT(outcome.out, testing::HasSubstr(message));
  }
  TempFolder tree;
};

TEST_F(LayersOfATree, AreKept) {
  const Outcome outcome = check_layers(tree.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST_F(LayersOfATree, WrongIncludeIsRefused) {
  const struct {
    std::string file, content, message;
  } all[] = {
      {"src/shelfbeam/math/frame.hpp", "#pragma once\n\n#  include \"shelfbeam/scene/scene.hpp\"\n",
       ":3: 'shelfbeam/scene/scene.hpp' is not for 'math'"},
      {"src/shelfbeam/scene/scene.hpp", "#include \"shelfbeam/scene/build/make_scene.hpp\"\n",
       ":1: 'shelfbeam/scene/build/make_scene.hpp' is not for 'scene'"},
      {"src/shelfbeam/milp/model.cpp", "#include \"shelfbeam/signal/signal_matrix.hpp\"\n",
       ":1: 'shelfbeam/signal/signal_matrix.hpp' is not for 'milp'"},
      {"test/unit/base/b_test.cpp", "#include <shelfbeam/math/vec3.hpp>\n",
       ":1: 'shelfbeam/math/vec3.hpp' is not for tests of 'base'"},
      {"src/app/verbs.cpp", "#include \"shelfbeam/transport/reuse/reuse.hpp\"\n",
       ":1: 'shelfbeam/transport/reuse/reuse.hpp' is for 'transport' alone"},
      {"src/shelfbeam/plan/rounds.cpp", "#include \"shelfbeam/placement/tree/proof.hpp\"\n",
       ":1: 'shelfbeam/placement/tree/proof.hpp' is for 'placement' alone"},
      {"src/shelfbeam/math/random.hpp", "#include \"../scene/scene.hpp\"\n",
       ":1: includes \"../scene/scene.hpp\" by a relative path"},
      {"src/serve/text/a.cpp", "#include \"serve/project/project.hpp\"\n",
       ":1: 'serve/project/project.hpp' is not for 'serve/text'"},
      {"src/shelfbeam/misc/a.cpp", "#include <vector>\n", ": its folder is not in the table"},
      {"src/shelfbeam/milp/highs.hpp", "#include <Highs.h>\n", ":1: a header includes HiGHS"},
  };
  for (const auto& [file, content, message] : all) {
    tree.write(file, content);
    expect_refused(file + message);
  }
}

TEST_F(LayersOfATree, LargeFilesAreRefused) {
  tree.write("src/shelfbeam/math/long.cpp", std::string(800, '\n'));
  EXPECT_EQ(check_layers(tree.path()).exit_code, 0);
  tree.write("src/shelfbeam/math/long.cpp", std::string(801, '\n'));
  expect_refused("src/shelfbeam/math/long.cpp: has 801 lines, more than 800");
  tree.write("study/long.py", std::string(801, '\n'));
  expect_refused("study/long.py: has 801 lines, more than 800");
}

TEST_F(LayersOfATree, InstalledHeadersIncludeOnlyInstalledHeaders) {
  tree.write("src/shelfbeam/CMakeLists.txt", "shelfbeam_layer(math PUBLIC math/vec3.hpp)\n");
  tree.write("src/shelfbeam/math/vec3.hpp", "#include <vector>\n#include \"shelfbeam/math/frame.hpp\"\n");
  expect_refused("src/shelfbeam/math/vec3.hpp:2: an installed header includes 'shelfbeam/math/frame.hpp'");
  tree.write("src/shelfbeam/math/vec3.hpp", "#include <tbb/parallel_for.h>\n");
  expect_refused("src/shelfbeam/math/vec3.hpp:1: an installed header includes <tbb/parallel_for.h>");
  tree.write("src/shelfbeam/shelfbeam.hpp", "#include \"shelfbeam/plan/plan.hpp\"\n");
  expect_refused("src/shelfbeam/shelfbeam.hpp:1: an installed header includes 'shelfbeam/plan/plan.hpp'");
}

TEST_F(LayersOfATree, HeavyDependencyStaysInOneSource) {
  tree.write("src/shelfbeam/signal/a.cpp", "#include <hdf5.h>\n");
  EXPECT_EQ(check_layers(tree.path()).exit_code, 0);
  tree.write("src/shelfbeam/signal/b.cpp", "#include <hdf5.h>\n");
  expect_refused(
      "HDF5 is included by more than one file: src/shelfbeam/signal/a.cpp, src/shelfbeam/signal/b.cpp");
}

TEST_F(LayersOfATree, BeastStaysInTwoSourcesOfTheServer) {
  tree.write("src/serve/http/loop.cpp", "#include <boost/asio/io_context.hpp>\n");
  tree.write("src/serve/http/session.cpp", "#include <boost/beast/http/read.hpp>\n");
  tree.write("src/shelfbeam/stats/a.cpp", "#include <boost/math/distributions/beta.hpp>\n");
  EXPECT_EQ(check_layers(tree.path()).exit_code, 0);
  tree.write("src/serve/live/a.cpp", "#include <boost/asio/post.hpp>\n");
  expect_refused("Beast is included by more than 2 files");
  expect_refused("src/serve/live/a.cpp: Beast is for src/serve/http alone");
}

TEST_F(LayersOfATree, FolderWithoutSourcesIsAnError) {
  EXPECT_EQ(check_layers(tree / "test").exit_code, 2);
}

}  // namespace
}  // namespace shelfbeam
