#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::test {

/// A plan, and all that its sentences are made of.
struct PlannedStore {
  std::string name;
  Scene scene;
  SignalMatrix matrix;
  SignalTable table;
  CertifiedPlan plan;
};

/// The subject of sentences: the simulated signals, the certificate, both ends of the reflectances, that no
/// selection reaches all labels, or mounted units without and with one more.
enum class Subject { signals, certificate, reflectances, nothing, without_addition, with_addition };

/// The values of a result by name, from its fields alone, without the functions that make sentences. Truth
/// values are 0 or 1. A name may have another value for one subject.
class Truth {
 public:
  explicit Truth(const PlannedStore& store);

  /// Throws std::out_of_range for a name without a value.
  double operator()(const std::string& name, Subject subject = Subject::signals) const;

 private:
  void add_counts(const PlannedStore& store);
  void add_labels(const PlannedStore& store);
  void add_bounds(const CertifiedPlan& plan);
  void add_certificate(const CertifiedPlan& plan);
  void add_alternatives(const Alternatives& alternatives);
  void add_sensitivity(const Sensitivity& sensitivity);
  void add_availability(const PlannedStore& store);
  void add_values(const CertifiedPlan& plan);
  void add_outcome(const std::string& name, const Availability& found, const StateOutcome& outcome,
                   std::optional<Subject> subject = {});

  std::map<std::string, double> values_;
  std::map<std::pair<Subject, std::string>, double> of_subject_;
};

}  // namespace shelfbeam::test
