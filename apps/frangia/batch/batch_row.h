#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

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

/// A row as JSON.
[[nodiscard]] nlohmann::ordered_json json_of(const BatchRow& row);

/// The rows as JSON.
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<BatchRow>& rows);

/// A row from its JSON.
///
/// @errors   nlohmann::json::exception for values of another kind
[[nodiscard]] BatchRow row_of(const nlohmann::ordered_json& json);

/// Takes the figures of a step's answer; what it does not state stays as it is.
void take_results(const nlohmann::ordered_json& results, BatchRow& row);

}  // namespace frangia
