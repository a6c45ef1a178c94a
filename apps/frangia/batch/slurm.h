#pragma once

#include <filesystem>
#include <string>

#include "batch/batch_task.h"

namespace frangia {

/// An array job of Slurm: one task a scan.
struct SlurmJob {
  std::filesystem::path plan;  ///< absolute
  std::filesystem::path out;   ///< absolute, on storage that all nodes see
  std::string program;         ///< absolute path on the nodes
  std::size_t scans = 0;       ///< number of tasks
  int threads = 1;             ///< cores of a task
  double memory_mb = 0.0;      ///< of a task
  double minutes = 0.0;        ///< of a task
  std::string options;         ///< more options for sbatch, such as "--partition=night"
};

/// The script of the array. A task that is requeued goes on, because done scans are skipped.
[[nodiscard]] std::string slurm_script(const SlurmJob& job);

/// Writes the scripts to OUT/slurm and submits the array and, after it, the job that writes the
/// table. Returns the number of the array job.
///
/// @errors   Error(Input) when sbatch is missing or refuses
[[nodiscard]] std::string submit(const SlurmJob& job, const std::stop_token& stop);

}  // namespace frangia
