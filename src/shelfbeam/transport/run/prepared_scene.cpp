#include "shelfbeam/transport/run/prepared_scene.hpp"

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/transport/run/make_estimator.hpp"

namespace shelfbeam {

namespace {

// Before anything large is allocated.
const Scene& that_fits(const Scene& scene, const SimulationOptions& options, bool keeps_matrix) {
  require_memory(scene, options, keeps_matrix);
  return scene;
}

std::unique_ptr<Estimator> estimator_that_fits(const World& world, const SimulationOptions& options,
                                               bool keeps_matrix, const RunControl& control) {
  auto estimator = make_estimator(world, options, control);
  require_memory(world, *estimator, options, keeps_matrix);
  return estimator;
}

}  // namespace

PreparedScene::PreparedScene(const Scene& scene, const SimulationOptions& options, bool keeps_matrix,
                             const RunControl& control)
    : world_(that_fits(scene, options, keeps_matrix)),
      estimator_(estimator_that_fits(world_, options, keeps_matrix, control)),
      labels_(options.part.is_whole() ? all_numbers<LabelId>(scene.labels.size()) : rows_of(*estimator_)),
      direct_(world_, options.rules(), labels_, control) {
  if (!direct_.is_complete()) throw Interrupted("the simulation was stopped");
}

PreparedScene::PreparedScene(const Scene& state, const PreparedScene& first, const SimulationOptions& options,
                             const RunControl& control)
    : world_(state),
      estimator_(first.estimator_->for_state(world_, options.seed)),
      labels_(all_numbers<LabelId>(state.labels.size())),
      direct_(world_, options.rules(), labels_, control) {
  if (!direct_.is_complete()) throw Interrupted("the simulation was stopped");
}

std::unique_ptr<const PreparedScene> prepare(const Scene& scene, const SimulationOptions& options,
                                             bool keeps_matrix, const RunControl& control) {
  const ThreadLimit allowed(control.threads);
  std::unique_ptr<const PreparedScene> prepared;
  with_threads(control.threads, [&] {
    prepared = std::make_unique<const PreparedScene>(scene, options, keeps_matrix, control);
  });
  return prepared;
}

}  // namespace shelfbeam
