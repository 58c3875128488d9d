#include "shelfbeam/transport/world/rough_coats.hpp"

#include <optional>

#include <gtest/gtest.h>

#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"

#include "physics/bare_scene.hpp"

namespace shelfbeam {
namespace {

// Signals of programs in which these coats were smooth have another light_hash, so they are not used again.
TEST(RoughCoats, ChangeTheLightOfCurvedMeshesOnly) {
  test::BareScene flat, curved;
  flat.box(flat.material(make_plastic(1.5, 0.8)), {0, 0, 0}, {6, 5, 3});
  curved.sphere(curved.material(make_plastic(1.5, 0.8)), 0.9, 3);
  EXPECT_FALSE(with_rough_coats(flat.scene));
  const std::optional<Scene> rough = with_rough_coats(curved.scene);
  ASSERT_TRUE(rough);
  EXPECT_EQ(rough->materials.size(), 2U);
  const auto hash = [](const Scene& scene) {
    return detail::matrix_head(scene, "", 1, "").provenance.light_hash;
  };
  EXPECT_EQ(hash(flat.scene), light_keys(flat.scene).light_hash);
  EXPECT_NE(hash(curved.scene), light_keys(curved.scene).light_hash);
}

}  // namespace
}  // namespace shelfbeam
