#include <algorithm>
#include <climits>
#include <cmath>
#include <vector>

#include <CbcConfig.h>
#include <CbcEventHandler.hpp>
#include <CbcModel.hpp>
#include <CbcStrategy.hpp>
#include <ClpEventHandler.hpp>
#include <ClpSimplex.hpp>
#include <CoinMessageHandler.hpp>
#include <CoinPackedMatrix.hpp>
#include <OsiClpSolverInterface.hpp>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/milp/backend.hpp"

namespace shelfbeam::milp {

namespace {

// COIN prints errors even at log level 0.
class Silent final : public CoinMessageHandler {
 public:
  int print() override { return 0; }
  CoinMessageHandler* clone() const override { return new Silent(*this); }
};

double bound(double value) {
  return std::clamp(value, -COIN_DBL_MAX, COIN_DBL_MAX);
}

// Columns and rows in the form that both CBC and Clp take.
struct Columns {
  std::vector<double> lower, upper, cost;

  Columns(std::span<const Column> columns, double cost_scale) {
    for (const Column& column : columns) {
      lower.push_back(bound(column.lower));
      upper.push_back(bound(column.upper));
      cost.push_back(column.cost * cost_scale);
    }
  }
};
struct CbcRows {
  std::vector<double> lower, upper, values;
  std::vector<int> indices;
  std::vector<CoinBigIndex> starts{0};

  explicit CbcRows(std::span<const Row> rows) {
    for (const Row& row : rows) {
      lower.push_back(bound(row.lower));
      upper.push_back(bound(row.upper));
      for (const Entry& entry : row.entries) {
        indices.push_back(static_cast<int>(entry.column));
        values.push_back(entry.value);
      }
      starts.push_back(static_cast<CoinBigIndex>(indices.size()));
    }
  }
};

void load(const Model& model, double cost_scale, OsiClpSolverInterface& solver) {
  const Columns columns(model.columns, cost_scale);
  const CbcRows rows(model.rows);
  const CoinPackedMatrix matrix(false, static_cast<int>(model.columns.size()),
                                static_cast<int>(model.rows.size()), rows.starts.back(), rows.values.data(),
                                rows.indices.data(), rows.starts.data(), nullptr);
  solver.loadProblem(matrix, columns.lower.data(), columns.upper.data(), columns.cost.data(),
                     rows.lower.data(), rows.upper.data());
  for (std::size_t j = 0; j < model.columns.size(); ++j)
    if (model.columns[j].integer) solver.setInteger(static_cast<int>(j));
}

// Replaces Clp's own limit, which counts the processor time of all threads.
class TimeLimit final : public ClpEventHandler {
 public:
  TimeLimit(const RunControl& control, const Deadline& deadline) : control_(control), deadline_(deadline) {}

  ClpEventHandler* clone() const override { return new TimeLimit(*this); }
  int event(Event which) override {
    const bool between_iterations = which == endOfIteration || which == endOfFactorization;
    return between_iterations && (control_.cancelled() || deadline_.has_passed()) ? 0 : -1;
  }

 private:
  const RunControl& control_;
  Deadline deadline_;
};

/// The results of a run before its deadline. Linear programs stop there (TimeLimit), and CBC then takes their
/// nodes for infeasible, so later bounds and claims are void.
struct Progress {
  double bound = -infinity;
  bool is_over = false;
};

class Watch final : public CbcEventHandler {
 public:
  Watch(const RunControl& control, const Deadline& deadline, BoundReport& report, Progress& progress,
        double cost_scale)
      : control_(control),
        deadline_(deadline),
        report_(report),
        progress_(progress),
        cost_scale_(cost_scale) {}

  CbcEventHandler* clone() const override { return new Watch(*this); }

  CbcAction event(CbcEvent which) override {
    progress_.is_over = progress_.is_over || control_.cancelled() || deadline_.has_passed();
    // Heuristics run on separate models with other bounds.
    if (model_ != nullptr && model_->parentModel() == nullptr && !progress_.is_over) {
      const double dual = model_->getBestPossibleObjValue();
      if (which == node && std::abs(dual) < 1e50) progress_.bound = dual / cost_scale_;
      report_(model_->getObjValue() / cost_scale_, dual / cost_scale_);
    }
    return progress_.is_over ? stop : noAction;
  }
  CbcAction event(CbcEvent which, void*) override { return event(which); }

 private:
  const RunControl& control_;
  const Deadline& deadline_;
  BoundReport& report_;
  Progress& progress_;
  double cost_scale_;
};

Termination to_termination(const CbcModel& cbc, const RunControl& control) {
  if (cbc.status() == 0) return cbc.bestSolution() ? Termination::optimal : Termination::infeasible;
  if (cbc.status() == 1 || cbc.status() == 5)
    return control.cancelled() ? Termination::interrupted : Termination::limit;
  return Termination::error;
}

class ClpSession final : public LpSession {
 public:
  explicit ClpSession(std::span<const Column> columns) : scale_(objective_scale(columns)) {
    silent_.setLogLevel(0);
    clp_.passInMessageHandler(&silent_);
    clp_.setLogLevel(0);
    const Columns all(columns, scale_);
    const std::vector<CoinBigIndex> starts(columns.size() + 1, 0);
    clp_.addColumns(static_cast<int>(columns.size()), all.lower.data(), all.upper.data(), all.cost.data(),
                    starts.data(), nullptr, nullptr);
  }

  void add_rows(std::span<const Row> rows) override {
    const CbcRows more(rows);
    clp_.addRows(static_cast<int>(rows.size()), more.lower.data(), more.upper.data(), more.starts.data(),
                 more.indices.data(), more.values.data());
  }

  void set_bounds(std::uint32_t column, double lower, double upper) override {
    clp_.setColumnBounds(static_cast<int>(column), bound(lower), bound(upper));
  }

  void set_cutoff(double objective) override {
    clp_.setDualObjectiveLimit(objective < infinity ? objective * scale_ : COIN_DBL_MAX);
  }

  std::vector<Probe> probe(std::span<const std::uint32_t> columns, int pivots) override {
    const std::size_t count = columns.size();
    std::vector<int> which(columns.begin(), columns.end()), status(2 * count), steps(2 * count);
    std::vector<double> up(count, 1.0), down(count, 0.0);
    const auto width = static_cast<std::size_t>(clp_.numberColumns());
    std::vector<std::vector<double>> solutions(2 * count, std::vector<double>(width));
    std::vector<double*> pointers;
    for (auto& solution : solutions) pointers.push_back(solution.data());
    const int before = clp_.maximumIterations();
    clp_.setMaximumIterations(pivots);
    // Clp's first list has the new lower bounds, its second the new upper ones; both return changes.
    clp_.strongBranching(static_cast<int>(count), which.data(), up.data(), down.data(), pointers.data(),
                         status.data(), steps.data(), false, true, 0);
    clp_.setMaximumIterations(before);
    std::vector<Probe> probes;
    for (std::size_t k = 0; k < count; ++k) {
      const auto change = [&](double value, int ended) { return ended == 1 ? infinity : value / scale_; };
      probes.push_back({change(down[k], status[2 * k]), change(up[k], status[2 * k + 1])});
    }
    return probes;
  }

  LpResult solve(double time_limit_s, const RunControl& control) override {
    if (control.cancelled()) return {Termination::interrupted, infinity, {}, {}};
    if (time_limit_s <= 0) return {Termination::limit, infinity, {}, {}};
    TimeLimit limit(control, Deadline(time_limit_s));
    clp_.passInEventHandler(&limit);
    clp_.dual();
    LpResult result;
    switch (clp_.status()) {
      case 0:
        break;
      case 1:
        return infeasible();
      case 3:
      case 5:
        return {control.cancelled() ? Termination::interrupted : Termination::limit, infinity, {}, {}};
      default:
        return {};
    }
    result.termination = Termination::optimal;
    result.x.assign(clp_.primalColumnSolution(), clp_.primalColumnSolution() + clp_.numberColumns());
    result.y = duals();
    result.objective = clp_.objectiveValue() / scale_;
    return result;
  }

 private:
  std::vector<double> duals() const {
    std::vector<double> y(clp_.dualRowSolution(), clp_.dualRowSolution() + clp_.numberRows());
    for (double& dual : y) dual /= scale_;
    return y;
  }

  // Infeasible or beyond the cut-off. Clp's ray has the opposite sign.
  LpResult infeasible() const {
    LpResult result{Termination::infeasible, infinity, {}, duals()};
    if (double* const ray = clp_.infeasibilityRay()) {
      for (int i = 0; i < clp_.numberRows(); ++i) result.ray.push_back(-ray[i]);
      delete[] ray;
    }
    return result;
  }

  double scale_;
  Silent silent_;
  ClpSimplex clp_;
};

}  // namespace

std::string_view cbc_version() {
  return CBC_VERSION;
}

Result solve_cbc(const Model& model, const SolveOptions& options, const RunControl& control) {
  const double scale = objective_scale(model.columns);
  Silent silent;
  silent.setLogLevel(0);
  OsiClpSolverInterface solver;
  solver.passInMessageHandler(&silent);
  load(model, scale, solver);
  const Deadline deadline(options.time_limit_s);
  TimeLimit limit(control, deadline);
  solver.getModelPtr()->passInEventHandler(&limit);

  CbcModel cbc(solver);
  cbc.passInMessageHandler(&silent);
  cbc.setLogLevel(0);
  cbc.setUseElapsedTime(true);
  cbc.setMaximumSeconds(std::clamp(options.time_limit_s, 0.0, 1e10));
  if (options.node_limit)
    cbc.setMaximumNodes(static_cast<int>(std::min<std::uint64_t>(*options.node_limit, INT_MAX)));
  if (options.cutoff < infinity) cbc.setCutoff(options.cutoff * scale);
  cbc.setAllowableFractionGap(options.relative_gap);
  cbc.setAllowableGap(0);
  cbc.setIntegerTolerance(1e-7);
  BoundReport report(control);
  Progress progress;
  const Watch watch(control, deadline, report, progress, scale);
  cbc.passInEventHandler(&watch);
  // Cuts at every node. No preprocessing: with it, CBC 2.10.8 sometimes returns fractional values as optimal.
  // Cut generators do not look at the clock, which matters for large models.
  constexpr CoinBigIndex max_entries_for_cuts = 1'000'000;
  CbcStrategyDefault strategy(0);
  if (solver.getNumElements() <= max_entries_for_cuts) cbc.setStrategy(strategy);
  cbc.branchAndBound();

  Result result;
  if (const double* x = cbc.bestSolution()) result.solution.assign(x, x + model.columns.size());
  if (progress.is_over || control.cancelled() || deadline.has_passed()) {
    result.termination = control.cancelled() ? Termination::interrupted : Termination::limit;
    result.dual_bound = progress.bound;
    return result;
  }
  result.termination = to_termination(cbc, control);
  if (const double dual = cbc.getBestPossibleObjValue(); dual > -1e50) result.dual_bound = dual / scale;
  return result;
}

Model read_cbc(const std::filesystem::path& path) {
  Silent silent;
  OsiClpSolverInterface solver;
  solver.passInMessageHandler(&silent);
  const int errors =
      path.extension() == ".lp" ? solver.readLp(path.c_str()) : solver.readMps(path.c_str(), "");
  if (errors != 0) throw InputError(path.string(), "is not a model for CBC", "give an MPS or LP file");
  const auto bound = [&](double value) {
    return value >= solver.getInfinity() ? infinity : value <= -solver.getInfinity() ? -infinity : value;
  };
  Model model;
  for (int j = 0; j < solver.getNumCols(); ++j)
    model.columns.push_back({solver.getObjCoefficients()[j], bound(solver.getColLower()[j]),
                             bound(solver.getColUpper()[j]), solver.isInteger(j), solver.getColName(j)});
  const CoinPackedMatrix& matrix = *solver.getMatrixByRow();
  for (int i = 0; i < solver.getNumRows(); ++i) {
    Row row{bound(solver.getRowLower()[i]), bound(solver.getRowUpper()[i]), {}, solver.getRowName(i)};
    const CoinShallowPackedVector entries = matrix.getVector(i);
    for (int k = 0; k < entries.getNumElements(); ++k)
      row.entries.push_back({static_cast<std::uint32_t>(entries.getIndices()[k]), entries.getElements()[k]});
    model.rows.push_back(std::move(row));
  }
  return model;
}

std::unique_ptr<LpSession> lp_cbc(std::span<const Column> columns) {
  return std::make_unique<ClpSession>(columns);
}

}  // namespace shelfbeam::milp
