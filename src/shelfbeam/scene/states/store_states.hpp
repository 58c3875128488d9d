#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/states/cause.hpp"
#include "shelfbeam/scene/states/free_floor.hpp"
#include "shelfbeam/scene/states/mounting_error.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// Throws InputError if the store has no section "variation".
void expect_variation(const Store& store);

/// Leaves some causes out of the variation of a store. Throws InputError if there are some, but no section
/// "variation".
void leave_out(Store& store, const std::vector<Cause>& causes);

/// The states of a shop: draws of the variation of its store file (docs/formats/store/variation.md). State k
/// depends on the store, the seed and k only.
class StoreStates {
 public:
  /// `scene` is that of the store; both must outlive the object. Throws InputError if the store has no
  /// section "variation".
  StoreStates(const Store& store, const Scene& scene, std::uint64_t seed);

  /// The store in state k, an ordinary store: its labels and candidates are listed in the order of the scene,
  /// people and objects are boxes, and it has no variation.
  Store state(std::uint64_t k) const { return state(StateNumbers(k), scene_); }
  /// Causes from different states, with the labels and transceivers of `devices` alone, some of the scene's.
  Store state(const StateNumbers& numbers, const Scene& devices) const;

  /// Whether the file does not leave a cause out.
  bool varies(Cause cause) const { return store_.variation->varies(cause); }
  /// The causes that change something, without reflectances.
  std::vector<Cause> causes() const;

 private:
  class Drawing;

  const Store& store_;
  const Scene& scene_;
  std::uint64_t seed_;
  FreeFloor floor_;
  MountingError mounting_;
  std::vector<double> open_doors_;  ///< share of the time, by fixture
};

}  // namespace shelfbeam
