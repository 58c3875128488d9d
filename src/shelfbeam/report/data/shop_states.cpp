#include "shelfbeam/report/data/shop_states.hpp"

#include <cstddef>
#include <utility>
#include <variant>

#include "shelfbeam/scene/fixture/fixture.hpp"
#include "shelfbeam/scene/fixture/turn.hpp"
#include "shelfbeam/scene/states/store_states.hpp"

namespace shelfbeam {

namespace {

ShopState::Block block_of(const Box& box) {
  const Vec3 size = box.max - box.min;
  ShopState::Block block{{}, box.min.z, box.max.z};
  for (const Vec2& local : {Vec2{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}}) {
    const Vec2 corner = turned(local, box.rotation_deg);
    block.footprint.push_back({box.min.x + corner[0], box.min.y + corner[1]});
  }
  return block;
}

}  // namespace

ShopState shop_state(const StoreStates& states, const Store& store, ShownState verdicts) {
  const Store drawn = states.state(verdicts.number);
  ShopState state{std::move(verdicts), {}, {}};
  for (std::size_t k = 0; k < drawn.fixtures.size(); ++k) {
    const Fixture& fixture = drawn.fixtures[k].value;
    // A state adds people and objects after the fixtures of the store.
    if (k >= store.fixtures.size())
      state.blocks.push_back(block_of(std::get<Box>(fixture)));
    else if (const Shelving* shelves = shelving_of(fixture); shelves != nullptr && shelves->doors_open)
      state.open_doors.push_back(shelves->id);
  }
  return state;
}

std::vector<ShopState> shop_states(const Store& store, const Scene& scene, const SignalMatrix& matrix,
                                   const CertifiedPlan& plan) {
  std::vector<ShopState> shown;
  if (!store.variation || !plan.availability || plan.availability->shown.empty()) return shown;
  const StoreStates states(store, scene, plan.seed.value_or(matrix.provenance.seed));
  for (const ShownState& verdicts : plan.availability->shown)
    shown.push_back(shop_state(states, store, verdicts));
  return shown;
}

}  // namespace shelfbeam
