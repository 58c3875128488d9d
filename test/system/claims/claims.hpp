#pragma once

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/testing.hpp"

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

/// Plans of small stores by number, the same on every machine: counts, prices and sums, both communication
/// models, with unit failure, installed units, little and ample budgets, several confidences, and some
/// without a certificate, without a selection, or interrupted. Some placements begin with a better bound than
/// the later searches find, so that the certified bound may be above that of the final matrix.
PlannedStore planned_store(std::uint32_t number);

/// Gives the values of a plan states in one of 8 ways: none, as up to version 0.4, or assumed, given and
/// confirmed ones. In the ways 2 and 7, a threshold is assumed.
void know_values(std::uint32_t way, CertifiedPlan& plan);

/// A plan for a shop that changes.
PlannedStore planned_for_states();

/// Makes it a plan by spend, with the same units.
void put_prices(PlannedStore& store);

struct Text {
  std::string text;
  Subject subject = Subject::signals;
};

/// The sentences of terminal and page about a plan.
std::vector<Text> texts_of(const PlannedStore& store);

/// A line of claims.txt: a text of the catalogue or the terminal, and the condition under which it is true.
struct Claim {
  std::string key;
  std::vector<std::string> places;
  std::function<bool(const Truth&)> is_true = {};
  std::optional<Subject> subject = {};  ///< of the rest of the text
};

const std::vector<Claim>& claims();

/// A text of a page with plain blanks in place of non-breaking ones.
std::string with_plain_blanks(std::string text);

/// A text as a sequence of the table's texts.
class ClaimReader {
 public:
  ClaimReader();

  /// The parts of a text that are not in the table, or that do not say the truth. `numbers`: if not null,
  /// gets the places of the numbers that were compared, in the text with plain blanks.
  std::vector<std::string> faults(std::string text, const Truth& truth, Subject subject,
                                  std::vector<std::size_t>* numbers = nullptr);

 private:
  // A part of a text between places "@".
  struct Part {
    const Claim* claim;
    std::vector<std::string> literals;  ///< one more than places
    std::vector<std::string> places;
  };
  struct Found {
    const Part* part = nullptr;
    std::size_t length = 0;
    std::vector<std::string> values;
    std::vector<std::size_t> at;  ///< of the values
  };
  static void match(const Part& part, std::string_view text, std::size_t at, std::size_t place, Found& found);
  static bool is_right(const Found& found, const Truth& truth, Subject subject);

  std::vector<Part> parts_;
};

}  // namespace shelfbeam::test
