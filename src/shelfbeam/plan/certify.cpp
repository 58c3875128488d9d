#include "shelfbeam/plan/certify.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/checker.hpp"
#include "shelfbeam/plan/decisive_rows.hpp"
#include "shelfbeam/plan/optimism.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/transport/simulate.hpp"

namespace shelfbeam {

namespace {

constexpr std::uint32_t most_batches = 1 << 16;
constexpr std::uint32_t growth = 4;  // of the batches, from round to round

enum class Purpose : std::uint64_t { verify = 1, bound, refine };

class Loop {
 public:
  Loop(const Scene& scene, const TableRule& rule, const CertifyOptions& options, SignalMatrix& matrix,
       Placement& placement, const RunControl& control)
      : scene_(scene),
        rule_(rule),
        options_(options),
        matrix_(matrix),
        placement_(placement),
        control_(control) {
    if (rule) table_ = rule(matrix);
    certificate_.confidence = options.confidence;
    certificate_.labels.resize(matrix.rows());
    for (std::size_t i = 0; i < matrix.rows(); ++i)
      certificate_.labels[i].requirement = matrix.labels[i].requirement;
  }

  Certificate run() {
    try {
      for (std::uint32_t round = 1; placement_.has_selection(); ++round) {
        certificate_.rounds = round;
        const double level = std::ldexp(1 - options_.confidence, -static_cast<int>(round)) / 2;
        verify_labels(round, level);
        if (!bound_holds()) prove_bound(round, level);
        if (is_done() || !goes_on()) break;
        improve(round);
      }
    } catch (const Interrupted&) {
      certificate_.open = "it was interrupted";
    }
    certificate_.seconds = seconds();
    return std::move(certificate_);
  }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  double left() const { return options_.budget_s - seconds(); }

  VerificationEffort effort(Purpose purpose, std::uint32_t round, std::uint32_t batches) const {
    const std::uint64_t stream = static_cast<std::uint64_t>(purpose) << 32 | round;
    return {options_.simulation, mix_key(options_.simulation.seed ^ 0x766572696679, stream), batches};
  }

  // Without a rule for a table there is nothing to choose from.
  bool is_fixed() const { return !rule_; }
  bool bound_holds() const {
    return is_fixed() || static_cast<double>(certificate_.count_lower_bound) >= placement_.count_lower_bound;
  }
  // Of units that hang already, missed labels are an answer, too.
  bool is_done() const {
    if (is_fixed()) return certificate_.count(Verdict::undecided) == 0;
    return certificate_.all_reached() && bound_holds();
  }

  std::vector<std::uint32_t> open_labels() const {
    std::vector<std::uint32_t> rows;
    for (std::uint32_t i = 0; i < certificate_.labels.size(); ++i) {
      const Verdict verdict = certificate_.labels[i].verdict;
      if (verdict == Verdict::undecided || (verdict == Verdict::missed && !is_fixed())) rows.push_back(i);
    }
    return rows;
  }

  // Labels that were reached by the same selection in a round before stay so.
  void verify_labels(std::uint32_t round, double level) {
    const std::vector<std::uint32_t> rows = open_labels();
    if (rows.empty()) return;
    control_.report("verifying", -1,
                    fmt::format("round {}, {} labels, {} batches", round, rows.size(), batches_));
    const Scene part = sub_scene(scene_, rows, placement_.selected);
    std::vector<float> planned;
    for (const std::uint32_t i : rows)
      for (const std::uint32_t j : placement_.selected) planned.push_back(matrix_.mean[matrix_.at(i, j)]);
    const double begun = seconds();
    const auto verdicts =
        verify(part, placement_.question, planned, level, effort(Purpose::verify, round, batches_), control_);
    verifying_took_ = seconds() - begun;
    for (std::size_t k = 0; k < rows.size(); ++k) certificate_.labels[rows[k]] = verdicts[k];
  }

  void prove_bound(std::uint32_t round, double level) {
    const auto count = static_cast<std::size_t>(placement_.count_lower_bound);
    Question question;
    question.model = placement_.question.model;
    question.redundant = placement_.question.redundant;
    const SignalTable expected = expected_optimism(
        table_, matrix_, std::max<std::size_t>(64, bound_rows_.size()), level, bound_batches_);
    control_.report("proving", -1, fmt::format("round {}: labels that need {} units", round, count));
    const DecisiveRows decisive =
        decisive_rows(expected, question, count, 0.3 * std::max(0.0, left()), control_);
    bound_rows_ = decisive.rows;
    control_.report(
        "proving", -1,
        fmt::format("round {}, {} labels, {} batches", round, bound_rows_.size(), bound_batches_));
    const double begun = seconds();
    OptimisticRows optimistic = optimistic_rows(scene_, table_, bound_rows_, level,
                                                effort(Purpose::bound, round, bound_batches_), control_);
    PlaceOptions options = options_.place;
    options.settles_ties = false;
    options.time_limit_s = std::min(options.time_limit_s, std::max(1.0, left()));
    const Placement fewest = place(optimistic.table, question, options, control_);
    bound_took_ = seconds() - begun;
    const double bound = std::min(fewest.count_lower_bound, static_cast<double>(count));
    if (static_cast<std::size_t>(bound) > certificate_.count_lower_bound) {
      certificate_.count_lower_bound = static_cast<std::size_t>(bound);
      certificate_.bound_labels = bound_rows_.size();
    }
    doubtful_.clear();
    fresh_.clear();
    if (bound_holds()) return;
    // Perhaps the matrix asks for too much: it will learn what has been seen, and more of the labels that
    // stand in the way of the smaller selection.
    fresh_ = std::move(optimistic.fresh);
    if (fewest.has_selection()) doubtful_ = worst_off(fewest.selected);
  }

  // Labels that a selection does not meet on the matrix, the worst first.
  std::vector<std::uint32_t> worst_off(const std::vector<std::uint32_t>& selected) const {
    constexpr std::size_t most = 64;
    const Check check = check_selection(table_, placement_.question, selected);
    std::vector<std::uint32_t> rows = check.unmet;
    std::sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(check.signal[a] / table_.labels[a].requirement, a) <
             std::pair(check.signal[b] / table_.labels[b].requirement, b);
    });
    rows.resize(std::min(rows.size(), most));
    return rows;
  }

  // Whether another round is worth its time; says why not.
  bool goes_on() {
    const std::uint32_t round = certificate_.rounds;
    if (control_.cancelled()) {
      certificate_.open = "it was interrupted";
      return false;
    }
    const double next_round = (certificate_.all_reached() ? 0 : growth * verifying_took_) +
                              (bound_holds() ? 0 : growth * bound_took_);
    if (left() < next_round || batches_ >= most_batches) {
      certificate_.open =
          fmt::format("the next round would have taken about {:.0f} s, and {:.0f} s were left", next_round,
                      std::max(0.0, left()));
      return false;
    }
    constexpr std::uint32_t rounds_before_giving_up = 2;
    if (const double needed = seconds_to_decide(); round >= rounds_before_giving_up && needed > 4 * left()) {
      certificate_.open = fmt::format("to decide the rest would take about {:.0f} s", needed);
      return false;
    }
    return true;
  }

  // As far as the labels that are still undecided are where their means are now.
  double seconds_to_decide() const {
    double most = 0;
    for (const LabelVerdict& label : certificate_.labels) {
      if (label.verdict != Verdict::undecided) continue;
      const double missing = std::abs(label.signal - label.requirement);
      const double width = (label.upper - label.lower) / 2;
      most = std::max(most, missing > 0 ? std::pow(width / missing, 2) : 1e12);
    }
    return std::min(most * verifying_took_, 1e12);
  }

  void improve(std::uint32_t round) {
    if (is_fixed()) {
      batches_ = std::min(growth * batches_, most_batches);
      return;
    }
    std::vector<std::uint32_t> rows = open_labels();
    rows.insert(rows.end(), doubtful_.begin(), doubtful_.end());
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (std::size_t k = 0; k < fresh_.size(); ++k) join(fresh_[k], bound_rows_[k], matrix_);
    if (!rows.empty() || !fresh_.empty()) {
      control_.report("refining", -1, fmt::format("round {}, {} labels", round, rows.size()));
      refine(scene_, rows, effort(Purpose::refine, round, std::min(growth * batches_, most_batches)), matrix_,
             control_);
      table_ = rule_(matrix_);
      PlaceOptions options = options_.place;
      options.time_limit_s = std::min(options.time_limit_s, std::max(1.0, left()));
      Placement other = place(table_, placement_.question, options, control_);
      if (other.has_selection() && other.selected != placement_.selected) {
        for (LabelVerdict& label : certificate_.labels) label.verdict = Verdict::undecided;
      } else {
        batches_ = std::min(growth * batches_, most_batches);
      }
      other.seconds += placement_.seconds;
      placement_ = std::move(other);
    }
    if (!bound_holds()) bound_batches_ = std::min(growth * bound_batches_, most_batches);
  }

  const Scene& scene_;
  const TableRule& rule_;
  const CertifyOptions& options_;
  SignalMatrix& matrix_;
  Placement& placement_;
  const RunControl& control_;
  SignalTable table_;
  Certificate certificate_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::uint32_t batches_ = least_verifying_batches, bound_batches_ = least_verifying_batches;
  double verifying_took_ = 0, bound_took_ = 0;
  std::vector<std::uint32_t> bound_rows_, doubtful_;
  std::vector<FreshRow> fresh_;  ///< of bound_rows_, where they did not prove the bound
};

}  // namespace

Certificate certify(const Scene& scene, const TableRule& table, const CertifyOptions& options,
                    SignalMatrix& matrix, Placement& placement, const RunControl& control) {
  return Loop(scene, table, options, matrix, placement, control).run();
}

Placement verify_installation(const Scene& scene, const Question& question, const CertifyOptions& options,
                              const RunControl& control) {
  SignalMatrix matrix = simulate(scene, {}, options.simulation, control).matrix;
  Placement placement;
  placement.question = question;
  placement.selected.resize(matrix.columns());
  std::iota(placement.selected.begin(), placement.selected.end(), 0U);
  placement.objective_value = static_cast<double>(placement.count());
  placement.certificate = certify(scene, {}, options, matrix, placement, control);
  return placement;
}

}  // namespace shelfbeam
