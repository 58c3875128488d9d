#include "jobs/steps/verification_step.hpp"

#include <utility>

#include "shelfbeam/plan/store/given_units.hpp"
#include "shelfbeam/plan/sub_scene.hpp"

namespace shelfbeam::jobs {

Installation installation_of(Store store, const std::filesystem::path& units,
                             const std::filesystem::path& name) {
  const Scene scene = make_scene(with_candidates_of(units, store));
  const Placement given = given_units(units, scene, name);
  return {std::move(store), with_units(scene, given.selected), given.problem};
}

Availability verify_in_states(const Installation& installation, const VerifyStatesOptions& options,
                              ResultLog& log, const RunControl& control) {
  const Scene scene = make_scene(installation.store);
  return verify_over_states(installation.store, scene, installation.scene, installation.problem, options, log,
                            control);
}

ExitCode exit_code_of(const Certificate& certificate) {
  if (certificate.count(Verdict::missed) > 0) return answer_is_no;
  return certificate.all_reached() ? done : stopped_early;
}

ExitCode exit_code_of(const Availability& availability) {
  if (availability.certified) return done;
  return availability.answer().keeps_to(availability.goal, availability.required) ? stopped_early
                                                                                  : answer_is_no;
}

}  // namespace shelfbeam::jobs
