#include "frangia/inspect/internal/edge_strips.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <Eigen/Geometry>

#include "frangia/geometry/connectivity.h"
#include "frangia/inspect/internal/vertex_use.h"

namespace frangia::inspect {
namespace {

using Eigen::Vector3f;

constexpr double kFlat = 0.9998;           // cosine of 1 degree: no bend
constexpr double kLeastTurn = 0.5;         // rad over the width, half of what makes an edge
constexpr float kTurned = 0.5F;            // cosine of 60 degrees
constexpr double kStepsOfWidth = 3.0;      // points along an edge, in a width
constexpr double kMostPoints = 1'000'000;  // of finely tessellated or damaged surfaces

/// An edge between two triangles that are no plane.
struct BentEdge {
  std::uint32_t half_edge;
  float length_mm;
};

/// Vectors along the normals of the triangles, of twice their area.
std::vector<Vector3f> crosses_of(const Mesh& mesh) {
  std::vector<Vector3f> crosses;
  crosses.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& at = mesh.vertices_mm;
    crosses.push_back((at[b] - at[a]).cross(at[c] - at[a]));
  }
  return crosses;
}

/// Whether a surface that bends between two triangles as around them turns far enough within a
/// width to matter: most of the edges of a fine tessellation do not.
bool bends(const Vector3f& one, const Vector3f& other, float length_mm, double width_mm) {
  const double areas = static_cast<double>(one.norm()) * static_cast<double>(other.norm());
  const double cosine = static_cast<double>(one.dot(other)) / areas;
  if (!(cosine < kFlat)) return false;  // also without an area
  if (cosine < std::cos(kSharpEdge)) return true;
  // The centroids lie a third of the triangles' heights from the edge.
  const auto apart = static_cast<double>((one.norm() + other.norm()) / (3.0F * length_mm));
  return std::acos(cosine) * width_mm >= kLeastTurn * apart;
}

}  // namespace

EdgeStrips::EdgeStrips(const Mesh& nominal, double width_mm)
    : width_mm_(width_mm), grid_(std::max(width_mm, 1e-6)) {
  if (!(width_mm > 0.0)) return;
  const HalfEdges edges(nominal);
  const std::vector<Vector3f> crosses = crosses_of(nominal);
  std::vector<BentEdge> bent;
  double length_mm = 0.0;
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (!edges.has_twin(edge) || edges.twin(edge) < edge) continue;
    const Vector3f way = nominal.vertices_mm[target_vertex(nominal, edge)] -
                         nominal.vertices_mm[source_vertex(nominal, edge)];
    const float length = way.norm();
    if (!bends(crosses[edge / 3], crosses[edges.twin(edge) / 3], length, width_mm)) continue;
    bent.push_back({edge, length});
    length_mm += static_cast<double>(length);
  }
  const double step_mm = std::max(width_mm / kStepsOfWidth, length_mm / kMostPoints);
  const double sharp = std::cos(kSharpEdge);
  for (const BentEdge& edge : bent) {
    const Vector3f one = crosses[edge.half_edge / 3].normalized();
    const Vector3f other = crosses[edges.twin(edge.half_edge) / 3].normalized();
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
