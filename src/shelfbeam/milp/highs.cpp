#include <algorithm>
#include <cmath>
#include <vector>

#include <Highs.h>

#include "shelfbeam/base/cores.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/milp/backend.hpp"

namespace shelfbeam::milp {

namespace {

// Rows without zero coefficients.
struct HighsRows {
  std::vector<double> lower, upper, values;
  std::vector<HighsInt> starts{0}, indices;

  explicit HighsRows(std::span<const Row> rows) {
    for (const Row& row : rows) {
      lower.push_back(row.lower);
      upper.push_back(row.upper);
      for (const Entry& entry : row.entries) {
        if (entry.value == 0) continue;
        indices.push_back(static_cast<HighsInt>(entry.column));
        values.push_back(entry.value);
      }
      starts.push_back(static_cast<HighsInt>(indices.size()));
    }
  }
};

HighsLp to_highs(std::span<const Column> columns, HighsRows rows, double cost_scale) {
  HighsLp lp;
  lp.num_col_ = static_cast<HighsInt>(columns.size());
  lp.num_row_ = static_cast<HighsInt>(rows.lower.size());
  lp.sense_ = ObjSense::kMinimize;
  for (const Column& column : columns) {
    lp.col_cost_.push_back(column.cost * cost_scale);
    lp.col_lower_.push_back(column.lower);
    lp.col_upper_.push_back(column.upper);
    lp.integrality_.push_back(column.integer ? HighsVarType::kInteger : HighsVarType::kContinuous);
  }
  HighsSparseMatrix& matrix = lp.a_matrix_;
  matrix.format_ = MatrixFormat::kRowwise;
  matrix.num_col_ = lp.num_col_;
  matrix.num_row_ = lp.num_row_;
  lp.row_lower_ = std::move(rows.lower);
  lp.row_upper_ = std::move(rows.upper);
  matrix.start_ = std::move(rows.starts);
  matrix.index_ = std::move(rows.indices);
  matrix.value_ = std::move(rows.values);
  return lp;
}

bool is_bounded(std::span<const Column> columns) {
  return std::all_of(columns.begin(), columns.end(), [](const Column& column) {
    return column.cost == 0 || (column.cost > 0 ? column.lower > -infinity : column.upper < infinity);
  });
}

Termination to_termination(HighsModelStatus status, std::span<const Column> columns) {
  switch (status) {
    case HighsModelStatus::kOptimal:
    case HighsModelStatus::kModelEmpty:
      return Termination::optimal;
    case HighsModelStatus::kInfeasible:
      return Termination::infeasible;
    case HighsModelStatus::kUnboundedOrInfeasible:
      return is_bounded(columns) ? Termination::infeasible : Termination::error;
    case HighsModelStatus::kTimeLimit:
    case HighsModelStatus::kSolutionLimit:  // of nodes
      return Termination::limit;
    case HighsModelStatus::kInterrupt:
      return Termination::interrupted;
    default:
      return Termination::error;
  }
}

// HiGHS keeps its worker threads for the next model and then rejects another number of threads.
struct SchedulerGuard {
  ~SchedulerGuard() { Highs::resetGlobalScheduler(true); }
};

class HighsSession final : public LpSession {
 public:
  explicit HighsSession(std::span<const Column> columns)
      : columns_(columns.begin(), columns.end()), scale_(objective_scale(columns)) {
    highs_.setOptionValue("output_flag", false);
    highs_.setOptionValue("threads", HighsInt{1});
    highs_.setOptionValue("solver", "simplex");
    highs_.setOptionValue("presolve", "off");  // presolve would discard the basis
    for (Column& column : columns_) column.integer = false;
    loaded_ = highs_.passModel(to_highs(columns_, HighsRows({}), scale_)) != HighsStatus::kError;
    highs_.setCallback(
        [this](int, const std::string&, const HighsCallbackDataOut*, HighsCallbackDataIn* in, void*) {
          in->user_interrupt = control_ != nullptr && control_->cancelled() ? 1 : 0;
        },
        nullptr);
    highs_.startCallback(kCallbackSimplexInterrupt);
  }

  void add_rows(std::span<const Row> rows) override {
    const HighsRows more(rows);
    const auto status = highs_.addRows(static_cast<HighsInt>(rows.size()), more.lower.data(),
                                       more.upper.data(), static_cast<HighsInt>(more.indices.size()),
                                       more.starts.data(), more.indices.data(), more.values.data());
    loaded_ = loaded_ && status != HighsStatus::kError;
  }

  void set_bounds(std::uint32_t column, double lower, double upper) override {
    highs_.changeColBounds(static_cast<HighsInt>(column), lower, upper);
  }

  void set_cutoff(double objective) override {
    highs_.setOptionValue("objective_bound", objective < infinity ? objective * scale_ : kHighsInf);
  }

  std::vector<Probe> probe(std::span<const std::uint32_t> columns, int pivots) override {
    const SchedulerGuard guard;
    const HighsBasis basis = highs_.getBasis();
    const double before = highs_.getInfo().objective_function_value;
    highs_.setOptionValue("simplex_iteration_limit", static_cast<HighsInt>(pivots));
    const auto change = [&](std::uint32_t column, double value) {
      highs_.changeColBounds(static_cast<HighsInt>(column), value, value);
      highs_.setBasis(basis);
      highs_.run();
      const bool is_empty = highs_.getModelStatus() == HighsModelStatus::kInfeasible ||
                            highs_.getModelStatus() == HighsModelStatus::kObjectiveBound;
      return is_empty ? infinity : (highs_.getInfo().objective_function_value - before) / scale_;
    };
    std::vector<Probe> probes;
    for (const std::uint32_t column : columns) {
      probes.push_back({change(column, 0), change(column, 1)});
      highs_.changeColBounds(static_cast<HighsInt>(column), 0, 1);
    }
    highs_.setOptionValue("simplex_iteration_limit", kHighsIInf);
    highs_.setBasis(basis);
    return probes;
  }

  LpResult solve(double time_limit_s, const RunControl& control) override {
    if (control.cancelled()) return {Termination::interrupted, infinity, {}, {}};
    if (!loaded_) return {};
    const SchedulerGuard guard;
    control_ = &control;
    highs_.zeroAllClocks();  // the time limit is on the sum of all solves
    highs_.setOptionValue("time_limit", std::max(time_limit_s, 0.0));
    const HighsStatus status = highs_.run();
    control_ = nullptr;
    if (status == HighsStatus::kError) return {};
    LpResult result;
    const bool is_beyond = highs_.getModelStatus() == HighsModelStatus::kObjectiveBound;
    result.termination =
        is_beyond ? Termination::infeasible : to_termination(highs_.getModelStatus(), columns_);
    if (result.termination == Termination::optimal || is_beyond) result.y = highs_.getSolution().row_dual;
    for (double& dual : result.y) dual /= scale_;
    if (result.termination == Termination::infeasible && !is_beyond) result.ray = dual_ray();
    if (result.termination != Termination::optimal) return result;
    result.x = highs_.getSolution().col_value;
    result.objective = highs_.getInfo().objective_function_value / scale_;
    return result;
  }

 private:
  std::vector<double> dual_ray() {
    bool has_ray = false;
    std::vector<double> ray(static_cast<std::size_t>(highs_.getNumRow()));
    highs_.getDualRay(has_ray, ray.data());
    return has_ray ? ray : std::vector<double>{};
  }

  std::vector<Column> columns_;
  double scale_;
  Highs highs_;
  bool loaded_ = false;
  const RunControl* control_ = nullptr;  ///< of the current solve
};

}  // namespace

std::string_view highs_version() {
  return ::highsVersion();
}

Result solve_highs(const Model& model, const SolveOptions& options, const RunControl& control) {
  const Deadline deadline(options.time_limit_s);  // loading takes time, too
  const SchedulerGuard guard;
  const double scale = objective_scale(model.columns);
  // HiGHS's workers busy-wait, so more of them than cores only slow each other down.
  const unsigned cores = core_count();
  const unsigned threads = control.threads != 0 ? std::min(control.threads, cores) : cores;

  Highs highs;
  highs.setOptionValue("output_flag", false);
  highs.setOptionValue("threads", static_cast<HighsInt>(threads));
  highs.setOptionValue("mip_rel_gap", options.relative_gap);
  highs.setOptionValue("mip_abs_gap", 0.0);
  // At the default of 1e-6, values such as -2e-7 count as integral, and pruning misses an objective by one.
  highs.setOptionValue("mip_feasibility_tolerance", 1e-7);
  // Presolve and the search for symmetries hardly look at the clock, which matters for large models.
  constexpr double preparation_s_per_entry = 2e-5;
  std::size_t entries = 0;
  for (const Row& row : model.rows) entries += row.entries.size();
  if (options.time_limit_s < preparation_s_per_entry * static_cast<double>(entries)) {
    highs.setOptionValue("presolve", "off");
    highs.setOptionValue("mip_detect_symmetry", false);
  }
  if (options.node_limit)
    highs.setOptionValue("mip_max_nodes",
                         static_cast<HighsInt>(std::min<std::uint64_t>(*options.node_limit, kHighsIInf)));
  if (options.cutoff < infinity) {
    highs.setOptionValue("objective_bound", options.cutoff * scale);
    highs.setOptionValue("mip_heuristic_effort", 0.0);
  }
  if (highs.passModel(to_highs(model.columns, HighsRows(model.rows), scale)) == HighsStatus::kError)
    return {};

  if (options.time_limit_s < infinity) {
    if (deadline.has_passed()) return {Termination::limit, infinity, -infinity, {}};
    highs.setOptionValue("time_limit", deadline.seconds_left());
  }
  BoundReport report(control);
  highs.setCallback(
      [&](int type, const std::string&, const HighsCallbackDataOut* out, HighsCallbackDataIn* in, void*) {
        if (type == kCallbackMipInterrupt) report(out->mip_primal_bound / scale, out->mip_dual_bound / scale);
        in->user_interrupt = control.cancelled() || deadline.has_passed() ? 1 : 0;
      },
      nullptr);
  highs.startCallback(kCallbackMipInterrupt);
  highs.startCallback(kCallbackSimplexInterrupt);
  highs.startCallback(kCallbackIpmInterrupt);
  if (highs.run() == HighsStatus::kError) return {};

  const bool is_mip = std::any_of(model.columns.begin(), model.columns.end(),
                                  [](const Column& column) { return column.integer; });
  Result result;
  result.termination = to_termination(highs.getModelStatus(), model.columns);
  if (result.termination == Termination::interrupted && !control.cancelled())
    result.termination = Termination::limit;
  // HiGHS returns a MIP solution that fails its own final check with "infeasible"; `verified` receives both.
  if (highs.getSolution().value_valid && (is_mip || result.termination == Termination::optimal))
    result.solution = highs.getSolution().col_value;
  if (is_mip)
    result.dual_bound = highs.getInfo().mip_dual_bound / scale;
  else if (result.termination == Termination::optimal)
    result.dual_bound = highs.getInfo().objective_function_value / scale;
  return result;
}

Model read_highs(const std::filesystem::path& path) {
  Highs highs;
  highs.setOptionValue("output_flag", false);
  if (highs.readModel(path.string()) == HighsStatus::kError)
    throw InputError(path.string(), "is not a model for HiGHS", "give an MPS or LP file");
  const HighsLp& lp = highs.getLp();
  Model model;
  for (std::size_t j = 0; j < static_cast<std::size_t>(lp.num_col_); ++j)
    model.columns.push_back({lp.col_cost_[j], lp.col_lower_[j], lp.col_upper_[j],
                             !lp.integrality_.empty() && lp.integrality_[j] == HighsVarType::kInteger,
                             lp.col_names_[j]});
  for (std::size_t i = 0; i < static_cast<std::size_t>(lp.num_row_); ++i)
    model.rows.push_back({lp.row_lower_[i], lp.row_upper_[i], {}, lp.row_names_[i]});
  HighsSparseMatrix matrix = lp.a_matrix_;
  matrix.ensureRowwise();
  for (std::size_t i = 0; i < model.rows.size(); ++i)
    for (auto k = static_cast<std::size_t>(matrix.start_[i]);
         k < static_cast<std::size_t>(matrix.start_[i + 1]); ++k)
      model.rows[i].entries.push_back({static_cast<std::uint32_t>(matrix.index_[k]), matrix.value_[k]});
  return model;
}

std::unique_ptr<LpSession> lp_highs(std::span<const Column> columns) {
  return std::make_unique<HighsSession>(columns);
}

}  // namespace shelfbeam::milp
