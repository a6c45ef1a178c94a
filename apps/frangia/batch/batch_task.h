#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "batch/batch_plan.h"

namespace frangia {

/// Where a scan of a batch stands.
enum class BatchState {
  Open,    ///< not tried yet, or interrupted
  Done,    ///< all steps ended well
  Failed,  ///< a step failed
};

/// One row of the table of a batch.
struct BatchRow {
  std::string name;                     ///< of the scan
  BatchState state = BatchState::Open;  ///< where it stands
  int exit_code = 0;                    ///< of the step that failed
  std::string message;                  ///< its first line; why the mesh must not be trusted
  double seconds = 0.0;                 ///< of all steps
  double processor_s = 0.0;             ///< of all steps
  double memory_mb = 0.0;               ///< most of any step
  std::size_t points = 0;               ///< measured
  std::size_t triangles = 0;            ///< of the mesh
  double sigma_mm = 0.0;                ///< median of the vertices; NaN: unknown
};

/// How the program is called for the steps of a batch.
struct BatchCommand {
  std::string program;  ///< path of this program
  int threads = 0;      ///< of each step; 0: the program's choice
};

/// The row of a scan from its mark OUT/NAME/done.json. It is open when there is none, or when the
/// scan, the options or the program have changed since.
[[nodiscard]] BatchRow read_row(const BatchScan& scan,
                                const BatchPlan& plan,
                                const std::filesystem::path& out);

/// Runs the steps of a scan, one process after the other, and leaves their results, messages and
/// done.json in OUT/NAME. done.json appears when all is over, by a rename. A stop leaves the scan
/// open.
///
/// @errors   Error(Input) when another process works on this scan; Error(File)
[[nodiscard]] BatchRow run_task(const BatchScan& scan,
                                const BatchPlan& plan,
                                const std::filesystem::path& out,
                                const BatchCommand& command,
                                const std::stop_token& stop);

/// The rows as JSON.
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<BatchRow>& rows);

}  // namespace frangia
