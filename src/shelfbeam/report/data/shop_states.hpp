#pragma once

#include <vector>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

class StoreStates;

/// One of the states of a store, with the verdicts of a plan in it.
ShopState shop_state(const StoreStates& states, const Store& store, ShownState verdicts);

/// The shown states of a plan, drawn again from the store, its scene, and the seed of the matrix. Empty for a
/// plan without such states or a store without variation.
std::vector<ShopState> shop_states(const Store& store, const Scene& scene, const SignalMatrix& matrix,
                                   const CertifiedPlan& plan);

}  // namespace shelfbeam
