#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/tally/analytic_direct.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// A scene with its estimator and its analytic direct light, ready for any number of simulations. Preparing
/// takes some seconds for a large store, mostly for the radiance cache.
class PreparedScene {
 public:
  PreparedScene(const Scene& scene, const SimulationOptions& options, bool keeps_matrix,
                const RunControl& control);

  /// Another state of a prepared scene, with the same labels, candidates and materials. It shares tables with
  /// `first`, which makes it cheap, and has few samples per batch (Estimator::for_state).
  PreparedScene(const Scene& state, const PreparedScene& first, const SimulationOptions& options,
                const RunControl& control);

  const World& world() const { return world_; }
  const Estimator& estimator() const { return *estimator_; }
  const detail::AnalyticDirect& direct() const { return direct_; }
  /// The labels that are simulated: all, or those of a part.
  const std::vector<LabelId>& labels() const { return labels_; }

 private:
  World world_;
  std::unique_ptr<Estimator> estimator_;
  std::vector<LabelId> labels_;
  detail::AnalyticDirect direct_;
};

/// Prepares a scene, which must outlive the result. Throws InputError if the options do not fit the scene or
/// require more than their memory limit, Interrupted when cancelled.
std::unique_ptr<const PreparedScene> prepare(const Scene& scene, const SimulationOptions& options,
                                             bool keeps_matrix, const RunControl& control = {});

}  // namespace shelfbeam
