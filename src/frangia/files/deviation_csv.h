#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include <Eigen/Core>

namespace frangia {

/// A compared vertex in a table.
struct DeviationRow {
  std::uint32_t vertex = 0;     ///< index in the mesh
  Eigen::Vector3f position_mm;  ///< of the vertex
  float deviation_mm = 0.0F;    ///< positive outside
  float u_mm = 0.0F;            ///< standard uncertainty; NaN: not known
  std::string_view conformity;  ///< in, out or undecided
};

/// Writes a CSV table with the header `vertex,x_mm,y_mm,z_mm,deviation_mm,u_mm,conformity`.
///
/// @units    mm
/// @missing  an unknown `u_mm` is empty
/// @errors   Error(File) when it cannot be written
void write_deviation_csv(const std::filesystem::path& path, std::span<const DeviationRow> rows);

}  // namespace frangia
