#include "frangia/inspect/internal/edge_strips.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <Eigen/Geometry>

#include "frangia/geometry/half_edges.h"
#include "frangia/inspect/internal/vertex_use.h"

namespace frangia::inspect {
namespace {

using Eigen::Vector3f;

constexpr double kFlat = 0.9998;           // cosine of 1 degree: no bend
constexpr float kTurned = 0.5F;            // cosine of 60 degrees
constexpr float kSameSide = -0.2F;         // cosine: as the limit of DeviationStatus::OtherSide
constexpr double kStepsOfWidth = 3.0;      // points along an edge, in a width
constexpr double kMostPoints = 1'000'000;  // of finely tessellated or damaged surfaces

/// An edge between two triangles that are no plane.
struct BentEdge {
  std::uint32_t half_edge;
  float length_mm;
};

std::vector<Vector3f> normals_of(const Mesh& mesh) {
  std::vector<Vector3f> normals;
  normals.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& at = mesh.vertices_mm;
    normals.push_back((at[b] - at[a]).cross(at[c] - at[a]).normalized());
  }
  return normals;
}

}  // namespace

EdgeStrips::EdgeStrips(const Mesh& nominal, double width_mm)
    : width_mm_(width_mm), grid_(std::max(width_mm, 1e-6)) {
  if (!(width_mm > 0.0)) return;
  const HalfEdges edges(nominal);
  const std::vector<Vector3f> normals = normals_of(nominal);
  std::vector<BentEdge> bent;
  double length_mm = 0.0;
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (!edges.has_twin(edge) || edges.twin(edge) < edge) continue;
    const double cosine = static_cast<double>(normals[edge / 3].dot(normals[edges.twin(edge) / 3]));
    if (!(cosine < kFlat)) continue;
    const Vector3f way = nominal.vertices_mm[target_vertex(nominal, edge)] -
                         nominal.vertices_mm[source_vertex(nominal, edge)];
    if (!way.allFinite()) continue;
    bent.push_back({edge, way.norm()});
    length_mm += static_cast<double>(way.norm());
  }
  const double step_mm = std::max(width_mm / kStepsOfWidth, length_mm / kMostPoints);
  const double sharp = std::cos(kSharpEdge);
  for (const BentEdge& edge : bent) {
    const Vector3f& one = normals[edge.half_edge / 3];
    const Vector3f& other = normals[edges.twin(edge.half_edge) / 3];
    const Vector3f& from = nominal.vertices_mm[source_vertex(nominal, edge.half_edge)];
    const Vector3f& to = nominal.vertices_mm[target_vertex(nominal, edge.half_edge)];
    const auto points = static_cast<std::size_t>(
        std::max(1.0, std::ceil(static_cast<double>(edge.length_mm) / step_mm)));
    for (std::size_t i = 0; i < points; ++i) {
      const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(points);
      grid_.add(from + share * (to - from));
      bends_.push_back({one, other, static_cast<double>(one.dot(other)) < sharp});
    }
  }
}

bool EdgeStrips::hold(const Vector3f& point, const Vector3f& normal) const {
  if (bends_.empty()) return false;
  bool found = false;
  const auto turned = [&](const Vector3f& beside) {
    const float cosine = normal.dot(beside);
    return cosine < kTurned && cosine >= kSameSide;
  };
  grid_.within(point, width_mm_, [&](std::uint32_t i, float) {
    const Bend& bend = bends_[i];
    found = found || bend.sharp || turned(bend.one) || turned(bend.other);
  });
  return found;
}

}  // namespace frangia::inspect
