#pragma once

#include <filesystem>
#include <string>

#include "frangia/core/run.h"

#include "batch/batch_plan.h"
#include "batch/batch_row.h"

namespace frangia {

/// How the program is called for the steps of a batch.
struct BatchCommand {
  std::string program;  ///< path of this program
  int threads = 0;      ///< of each step; 0: the program's choice
};

/// How the files of a scan and its results are compared with the record of what was done.
struct CheckFiles {
  bool all = false;  ///< every file by its checksum; else those whose stamp differs
  Run run{};
};

/// The row of a scan from its mark OUT/NAME/done.json. It is open when there is none, or when the
/// options, the program, a file that it depends on or a result have changed since; its message then
/// names the file. With `check.all`, a frame that does not have the checksum of the manifest is a
/// failure of the scan.
///
/// @errors   Error(Cancelled)
[[nodiscard]] BatchRow read_row(const BatchScan& scan,
                                const BatchPlan& plan,
                                const std::filesystem::path& out,
                                const CheckFiles& check);

/// Runs the steps of a scan, one process after the other, and leaves their results, messages and
/// done.json in OUT/NAME. done.json appears when all is over and on the disk, by a rename. Each
/// step holds the lock of OUT/NAME, so that one that outlives this process keeps others out. A stop
/// leaves the scan open, and so does another process that holds the lock, which the message names.
///
/// @errors   Error(File)
[[nodiscard]] BatchRow run_task(const BatchScan& scan,
                                const BatchPlan& plan,
                                const std::filesystem::path& out,
                                const BatchCommand& command,
                                const CheckFiles& check);

}  // namespace frangia
