#include "app/batch/slurm.hpp"

#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "app/batch/own_files.hpp"
#include "jobs/child.hpp"

namespace shelfbeam::app {

using namespace jobs;

namespace {

// A word of a shell command.
std::string shell_word(std::string_view word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string line_of(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

// A path in the file name patterns of sbatch, in which % begins a replacement symbol.
std::string log_path(const std::filesystem::path& folder) {
  std::string pattern;
  for (const char c : folder.string()) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  // Slurm removes it, and replaces no symbol.
  if (pattern.find('\\') != std::string::npos)
    throw InputError(folder.string(), "has a backslash in its path, which the logs of Slurm cannot have",
                     "choose another folder");
  return pattern;
}

// The options behind the value that sbatch refuses.
std::string remedy(std::string_view reason) {
  const auto mentions = [&](std::string_view word) {
    return lower_case(reason).find(word) != std::string::npos;
  };
  if (mentions("job array")) return "reduce '--tasks': 'scontrol show config' lists the limit MaxArraySize";
  if (mentions("submit")) return "reduce '--tasks' or '--task-time', or wait until other jobs have ended";
  if (mentions("time limit") || mentions("--time")) return "correct '--task-time'";
  if (mentions("memory")) return "reduce '--memory'";
  if (mentions("cpu") || mentions("processors")) return "reduce '--threads'";
  if (mentions("node configuration")) return "reduce '--threads' or '--memory'";
  if (mentions("contact") || mentions("socket")) return "try again when the controller of Slurm answers";
  return "add or correct options of sbatch, e.g. '--sbatch=--partition=NAME'";
}

// Returns the id of the job.
std::string sbatch(std::vector<std::string> options, const std::filesystem::path& script) {
  std::vector<std::string> words{"sbatch", "--parsable"};
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(script.string());
  Child child(words);
  ChildEnd end;
  while (!child.has_ended(end)) wait_for_children(1);
  if (end.exit_code == 127)
    throw InputError("sbatch", "cannot be run", "run this command on a login node of a Slurm cluster");
  if (end.exit_code != 0) {
    const std::string reason = end.err.substr(0, end.err.find('\n'));
    throw InputError(script.string(), fmt::format("is not accepted by Slurm ({})", reason), remedy(end.err));
  }
  return end.out.substr(0, end.out.find_first_of(";\n"));
}

}  // namespace

std::string slurm_script(const SlurmBatch& batch) {
  std::string head = fmt::format(
      "#!/bin/bash\n#SBATCH --job-name=shelfbeam\n#SBATCH --array=1-{}\n#SBATCH --cpus-per-task={}\n"
      "#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --signal=B:INT@60\n",
      batch.tasks, batch.threads);
  if (batch.memory > 0) head += fmt::format("#SBATCH --mem={}M\n", (batch.memory + (1 << 20) - 1) >> 20);
  if (!batch.time.empty()) head += fmt::format("#SBATCH --time={}\n", batch.time);
  for (const std::string& option : batch.options) head += fmt::format("#SBATCH {}\n", option);
  const std::size_t end = batch.command.size();
  std::size_t options = 0;  // of plan, after "--"
  while (options < end && batch.command[options] != "--") ++options;
  const auto at = batch.command.begin() + static_cast<std::ptrdiff_t>(options);
  return head + fmt::format(R"(
# Slurm sends INT a minute before the time limit. The plans then save their checkpoints, and the task continues
# from them in the queue. The plans get TERM, because commands in the background ignore INT when they start.
stopped= again= plans=
stop() {{ stopped=yes; if [[ $plans ]]; then kill -TERM "$plans"; fi; }}
trap 'again=yes; stop' INT
trap stop TERM
{} --part "$SLURM_ARRAY_TASK_ID/{}" {} &
plans=$!
if [[ $stopped ]]; then kill -TERM "$plans"; fi # the signal has come before the number was known
wait "$plans"
code=$?
if [[ $stopped ]]; then # the signal has ended the wait
  wait "$plans"
  code=$?
fi
# 143: the signal has come before the program could handle it.
if [[ $again && ( $code == 3 || $code == 143 ) && ${{SLURM_RESTART_COUNT:-0}} -lt 20 ]]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit "$code"
)",
                            line_of({batch.command.begin(), at}), batch.tasks,
                            line_of({at, batch.command.end()}));
}

SlurmJobs submit(const SlurmBatch& batch) {
  const auto logs = batch.folder / std::filesystem::path(tasks_name).parent_path();
  const std::string pattern = log_path(logs);
  make_output_folder(logs);
  std::string head = "#!/bin/bash\n#SBATCH --job-name=shelfbeam-results\n#SBATCH --requeue\n";
  for (const std::string& option : batch.options) head += fmt::format("#SBATCH {}\n", option);
  replace_own_files(batch.folder, {{tasks_name, slurm_script(batch)},
                                   {collection_name, head + "exec " + line_of(batch.collection) + "\n"}});
  SlurmJobs jobs;
  jobs.array = sbatch({"--output=" + pattern + "/%a.log"}, batch.folder / tasks_name);
  jobs.collection = sbatch({"--output=" + pattern + "/collect.log", "--dependency=afterany:" + jobs.array},
                           batch.folder / collection_name);
  return jobs;
}

}  // namespace shelfbeam::app
