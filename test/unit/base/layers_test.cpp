#include "support/process.hpp"
#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

// scripts/check/style checks this repository.
Outcome check_layers(const std::filesystem::path& root) {
  return run({SHELFBEAM_SOURCE_DIR "/scripts/check/layers", root.string()});
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
    tree.write("src/shelfbeam/math/long.cpp", std::string(800, '\n'));
    tree.write("src/shelfbeam/signal/a.cpp", "#include <hdf5.h>\n");
    tree.write("src/serve/http/loop.cpp", "#include <boost/asio/io_context.hpp>\n");
    tree.write("src/serve/http/session.cpp", "#include <boost/beast/http/read.hpp>\n");
    tree.write("src/shelfbeam/stats/a.cpp", "#include <boost/math/distributions/beta.hpp>\n");
  }
  TempFolder tree;
};

TEST_F(LayersOfATree, AreKept) {
  const Outcome outcome = check_layers(tree.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
}

TEST_F(LayersOfATree, FaultsAreNamed) {
  tree.write("src/shelfbeam/CMakeLists.txt", "shelfbeam_layer(math PUBLIC math/vec3.hpp math/warp.hpp)\n");
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
      {"src/shelfbeam/plan/long.cpp", std::string(801, '\n'), ": has 801 lines, more than 800"},
      {"study/long.py", std::string(801, '\n'), ": has 801 lines, more than 800"},
      {"src/shelfbeam/math/vec3.hpp", "#include <vector>\n#include \"shelfbeam/math/frame.hpp\"\n",
       ":2: an installed header includes 'shelfbeam/math/frame.hpp'"},
      {"src/shelfbeam/math/warp.hpp", "#include <tbb/parallel_for.h>\n",
       ":1: an installed header includes <tbb/parallel_for.h>"},
      {"src/shelfbeam/shelfbeam.hpp", "#include \"shelfbeam/plan/plan.hpp\"\n",
       ":1: an installed header includes 'shelfbeam/plan/plan.hpp'"},
      {"src/serve/live/a.cpp", "#include <boost/asio/post.hpp>\n", ": Beast is for src/serve/http alone"},
  };
  for (const auto& [file, content, message] : all) tree.write(file, content);
  tree.write("src/shelfbeam/signal/b.cpp", "#include <hdf5.h>\n");
  const Outcome outcome = check_layers(tree.path());
  EXPECT_EQ(outcome.exit_code, 1);
  for (const auto& [file, content, message] : all)
    EXPECT_THAT(outcome.out, testing::HasSubstr(file + message));
  EXPECT_THAT(outcome.out,
              testing::HasSubstr("HDF5 is included by more than one file: src/shelfbeam/signal/a.cpp, "
                                 "src/shelfbeam/signal/b.cpp"));
  EXPECT_THAT(outcome.out, testing::HasSubstr("Beast is included by more than 2 files"));
  EXPECT_EQ(std::ranges::count(outcome.out, '\n'), static_cast<int>(std::size(all)) + 2) << outcome.out;
}

TEST_F(LayersOfATree, FolderWithoutSourcesIsAnError) {
  EXPECT_EQ(check_layers(tree / "test").exit_code, 2);
}

}  // namespace
}  // namespace shelfbeam::test
