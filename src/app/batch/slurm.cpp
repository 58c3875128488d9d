#include "app/batch/slurm.hpp"

#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "app/batch/child.hpp"

namespace shelfbeam::app {

namespace {

constexpr auto tasks_name = "plan.sh", collection_name = "collect.sh";

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
  if (end.exit_code != 0)
    throw InputError(script.string(),
                     fmt::format("is not accepted by Slurm ({})", end.err.substr(0, end.err.find('\n'))),
                     "correct the options");
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
# from them in the queue.
stopped= again=
trap 'stopped=yes again=yes; kill -INT "$plans"' INT
trap 'stopped=yes; kill -INT "$plans"' TERM
{} --part "$SLURM_ARRAY_TASK_ID/{}" {} &
plans=$!
wait "$plans"
code=$?
if [[ $stopped ]]; then # the signal has ended the wait
  wait "$plans"
  code=$?
fi
if [[ $again && $code == 3 && ${{SLURM_RESTART_COUNT:-0}} -lt 20 ]]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit "$code"
)",
                            line_of({batch.command.begin(), at}), batch.tasks,
                            line_of({at, batch.command.end()}));
}

SlurmJobs submit(const SlurmBatch& batch) {
  make_output_folder(batch.folder);
  const auto tasks = batch.folder / tasks_name, collection = batch.folder / collection_name;
  write_file(tasks, slurm_script(batch));
  std::string head = "#!/bin/bash\n#SBATCH --job-name=shelfbeam-results\n#SBATCH --requeue\n";
  for (const std::string& option : batch.options) head += fmt::format("#SBATCH {}\n", option);
  write_file(collection, head + "exec " + line_of(batch.collection) + "\n");
  SlurmJobs jobs;
  jobs.array = sbatch({"--output=" + (batch.folder / "%a.log").string()}, tasks);
  jobs.collection =
      sbatch({"--output=" + (batch.folder / "collect.log").string(), "--dependency=afterany:" + jobs.array},
             collection);
  return jobs;
}

}  // namespace shelfbeam::app
