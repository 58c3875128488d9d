#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/file.hpp"

#include "jobs/plan_record.hpp"

namespace shelfbeam::jobs {

/// Names of the files in the folder of a plan. Without placement.json a plan is incomplete.
inline constexpr auto signal_name = "signal.h5";
inline constexpr auto placement_name = "placement.json";
inline constexpr auto store_name = "store.json";
inline constexpr auto labels_name = "labels.csv";
inline constexpr auto placement_table_name = "placement.csv";
inline constexpr auto bill_name = "bill.csv";
inline constexpr auto mounting_table_name = "mounting.csv";
inline constexpr auto mounting_drawing_name = "mounting.dxf";
inline constexpr auto verification_name = "verification.csv";
inline constexpr auto report_name = "report.html";
inline constexpr auto run_name = "run.json";
inline constexpr auto states_checkpoint_name = "states.checkpoint";  ///< of an interrupted run
/// The files of a plan. The first is blamed first: without it, no other is known.
inline constexpr std::array plan_file_names{
    placement_name,        store_name,           signal_name, verification_name,
    labels_name,           placement_table_name, bill_name,   mounting_table_name,
    mounting_drawing_name, report_name,          run_name};

/// The folder of a plan during a run, which no other run can use.
class PlanFolder {
 public:
  /// Makes the folder. `store`: the resolved store of this run. Throws InputError if another run uses the
  /// folder, if the folder contains a finished plan and `overwrite` is false, and if a file of a plan's names
  /// was not written by an earlier run, or has been changed since; OutputError if a file cannot be written.
  /// The error about a finished plan says whether its signals can be reused.
  PlanFolder(std::filesystem::path folder, std::string store, bool overwrite,
             const std::function<bool()>& can_reuse);
  /// Removes the folder and those above it again if they are new and empty.
  ~PlanFolder();
  PlanFolder(const PlanFolder&) = delete;
  PlanFolder& operator=(const PlanFolder&) = delete;

  /// Whether it contains a plan that was not interrupted.
  bool has_finished_plan() const { return has_finished_plan_; }

  /// Replaces the plan in the folder. `hashes`: of all new files except placement.json. Throws OutputError,
  /// also if the folder contains files that the constructor would refuse.
  void commit(AtomicFolder& files, const FileHashes& hashes) const;

 private:
  struct Found;
  Found look() const;

  struct Made {
    std::filesystem::path path;
    std::vector<std::filesystem::path> levels;  ///< that did not exist, the lowest first
    explicit Made(std::filesystem::path folder);
    ~Made() { remove(); }
    void remove() const;
  };

  Made folder_;
  std::string store_;
  bool overwrite_;
  OutputLock lock_;
  bool has_finished_plan_ = false;
};

}  // namespace shelfbeam::jobs
