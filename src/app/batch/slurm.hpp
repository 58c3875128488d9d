#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace shelfbeam::app {

/// The tasks of a batch for the Slurm workload manager.
struct SlurmBatch {
  std::vector<std::string> command;     ///< that plans the stores; tasks add their part
  std::vector<std::string> collection;  ///< that writes the results
  std::filesystem::path folder;         ///< of the batch, absolute
  std::uint32_t tasks = 1;
  unsigned threads = 1;              ///< per task
  std::size_t memory = 0;            ///< per task, bytes; 0: the cluster's default
  std::string time;                  ///< limit per task, as Slurm reads it; empty: the cluster's default
  std::vector<std::string> options;  ///< further options of sbatch
};

/// The script of the array of tasks. A task that reaches its time limit saves its checkpoints and is queued
/// again, at most 20 times; so is a task whose node fails.
std::string slurm_script(const SlurmBatch& batch);

/// The ids of the array and of the job that writes the results after it.
struct SlurmJobs {
  std::string array, collection;
};

/// Writes both scripts, and submits them with sbatch. Throws InputError with the message of sbatch if Slurm
/// does not accept them or cannot write its logs there, and OutputError, also for scripts that a person has
/// changed.
SlurmJobs submit(const SlurmBatch& batch);

}  // namespace shelfbeam::app
