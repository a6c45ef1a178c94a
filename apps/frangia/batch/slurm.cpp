#include "batch/slurm.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/core/read_file.h"

#include "batch/child_process.h"
#include "shell_quoted.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

void write_script(const fs::path& path, const std::string& text) {
  write_text_file(path, text);
  fs::permissions(path, fs::perms::owner_exec, fs::perm_options::add);
}

// Slurm reads its directives by rules of its own, with %; the shell alone reads the paths.
std::string table_script(const SlurmJob& job) {
  return fmt::format(
      "#!/bin/sh\n#SBATCH --job-name=frangia-table\n#SBATCH --ntasks=1\n#SBATCH --time=10\n"
      "#SBATCH --output=/dev/null\nexec >{} 2>&1\nexec {} batch {} -o {} --table\n",
      shell_quoted((job.out / "slurm" / "table.log").string()),
      shell_quoted(job.program),
      shell_quoted(job.plan.string()),
      shell_quoted(job.out.string()));
}

/// Calls sbatch and returns the number of the job.
std::string sbatch(const std::vector<std::string>& words,
                   const fs::path& folder,
                   const std::stop_token& stop) {
  std::vector<std::string> command{"sbatch", "--parsable"};
  command.insert(command.end(), words.begin(), words.end());
  const fs::path output = folder / "sbatch.txt";
  const fs::path messages = folder / "sbatch.log";
  ChildResult result;
  try {
    result = run_child(command, output, messages, stop);
  } catch (const Error&) {
    throw Error(
        ErrorKind::Input,
        "there is no `sbatch` here; install Slurm's client, or leave out --slurm to work on "
        "this computer");
  }
  if (result.exit_code != 0) {
    const std::string said = read_text_file(messages);
    throw Error(ErrorKind::Input,
                fmt::format("sbatch refused the job: {}", said.substr(0, said.find('\n'))));
  }
  const std::string number = read_text_file(output);
  return number.substr(0, number.find_first_of(";\n"));
}

}  // namespace

std::string slurm_script(const SlurmJob& job) {
  return fmt::format(
      "#!/bin/sh\n#SBATCH --job-name=frangia\n#SBATCH --array=0-{}\n#SBATCH --requeue\n"
      "#SBATCH --ntasks=1\n#SBATCH --cpus-per-task={}\n#SBATCH --mem={}M\n#SBATCH --time={}\n"
      "#SBATCH --output=/dev/null\n"
      "exec >{}/\"$SLURM_ARRAY_TASK_ID\".log 2>&1\n"
      "# A failed scan is a row of the table, not a failed task.\n"
      "exec {} --threads {} batch {} -o {} --task \"$SLURM_ARRAY_TASK_ID\"\n",
      job.scans - 1,
      job.threads,
      std::max(64, static_cast<int>(std::ceil(job.memory_mb))),
      std::max(1, static_cast<int>(std::ceil(job.minutes))),
      shell_quoted((job.out / "slurm").string()),
      shell_quoted(job.program),
      job.threads,
      shell_quoted(job.plan.string()),
      shell_quoted(job.out.string()));
}

std::string submit(const SlurmJob& job, const std::stop_token& stop) {
  const fs::path folder = path_below(job.out, "slurm");
  make_folder(folder);
  write_script(folder / "scans.sh", slurm_script(job));
  write_script(folder / "table.sh", table_script(job));
  std::vector<std::string> words;
  if (!job.options.empty()) words.push_back(job.options);
  words.push_back((folder / "scans.sh").string());
  const std::string array = sbatch(words, folder, stop);
  static_cast<void>(
      sbatch({"--dependency=afterany:" + array, (folder / "table.sh").string()}, folder, stop));
  return array;
}

}  // namespace frangia
