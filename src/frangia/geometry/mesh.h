#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// Where a vertex or a triangle has its place from. A larger one is less of a measurement.
enum class Mark : std::uint8_t {
  Measured,    ///< as the scan has it, or moved within its own sigma
  Displaced,   ///< by more than its sigma
  Synthesized  ///< put where nothing was measured
};

/// Triangles, counter-clockwise seen from outside, in the object frame.
struct Mesh {
  using Triangle = std::array<std::uint32_t, 3>;

  std::vector<Eigen::Vector3f> vertices_mm;
  std::vector<Triangle> triangles;
  std::vector<Eigen::Vector3f> normals;  ///< unit, one a vertex, or empty
  std::vector<float> sigma_mm;  ///< standard deviation along the normal, one a vertex, or empty
  std::vector<std::uint16_t> views;  ///< how many saw it, one a vertex, or empty
  std::vector<Mark> vertex_marks;    ///< one a vertex, or empty: all measured
  std::vector<Mark> triangle_marks;  ///< one a triangle, or empty: all measured

  [[nodiscard]] bool empty() const { return triangles.empty(); }
};

/// Vertex normals as the mean of the triangles around, each weighted by its angle there.
///
/// missing  a vertex without a triangle of positive area keeps a zero normal
[[nodiscard]] std::vector<Eigen::Vector3f> vertex_normals(const Mesh& mesh);

}  // namespace frangia
