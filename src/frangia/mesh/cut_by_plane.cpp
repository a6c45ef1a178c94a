#include "frangia/mesh/cut_by_plane.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/triangulate_polygon.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/steps_per_check.h"

namespace frangia {
namespace {

using Plane = Eigen::Hyperplane<double, 3>;
using Eigen::Vector3d;
using VertexLoop = std::vector<std::uint32_t>;

// Vertices nearer to the plane than this fraction of the largest coordinate lie on it, which avoids
// slivers: 4 units in the last place of single precision.
constexpr double kOnPlane = 5e-7;

double on_plane_distance_mm(const Mesh& mesh) {
  float largest_mm = 0.0F;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    if (vertex.allFinite()) largest_mm = std::max(largest_mm, vertex.cwiseAbs().maxCoeff());
  return kOnPlane * static_cast<double>(largest_mm);
}

class Cutter {
 public:
  Cutter(Mesh& mesh, const Plane& plane) : mesh_(mesh) {
    const double on_plane_mm = on_plane_distance_mm(mesh);
    heights_.reserve(mesh.vertices_mm.size());
    for (const Eigen::Vector3f& vertex : mesh.vertices_mm) {
      const double height = plane.signedDistance(vertex.cast<double>());
      heights_.push_back(std::abs(height) < on_plane_mm ? 0.0 : height);
    }
  }

  void cut(const Run& run) {
    const std::size_t count = mesh_.triangles.size();
    std::vector<std::uint8_t> keep(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (i % kStepsPerCheck == 0) run.check();
      const Mesh::Triangle triangle = mesh_.triangles[i];
      const auto above = std::count_if(
          triangle.begin(), triangle.end(), [&](std::uint32_t v) { return heights_[v] > 0.0; });
      const auto below = std::count_if(
          triangle.begin(), triangle.end(), [&](std::uint32_t v) { return heights_[v] < 0.0; });
      keep[i] = above > 0 && below == 0 ? 1 : 0;
      if (above > 0 && below > 0) {
        const Mark mark = mesh_.triangle_marks.empty() ? Mark::Measured : mesh_.triangle_marks[i];
        add_above(triangle, mark);
      }
    }
    keep.resize(mesh_.triangles.size(), 1);
    keep_triangles(mesh_, keep);
  }

 private:
  /// Adds the part of a triangle above the plane: its corners there and the cut points of its
  /// edges.
  void add_above(const Mesh::Triangle& triangle, Mark mark) {
    std::vector<std::uint32_t> polygon;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i];
      const std::uint32_t b = triangle[(i + 1) % 3];
      if (heights_[a] >= 0.0) polygon.push_back(a);
      if (heights_[a] * heights_[b] < 0.0) polygon.push_back(crossing(a, b));
    }
    for (std::size_t i = 2; i < polygon.size(); ++i)
      add_triangle(mesh_, {polygon[0], polygon[i - 1], polygon[i]}, mark);
  }

  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const std::uint64_t key = (std::uint64_t{a} << 32U) | b;
    const auto found = crossings_.find(key);
    if (found != crossings_.end()) return found->second;
    const double t = heights_[a] / (heights_[a] - heights_[b]);
    const std::uint32_t fresh = add_interpolated_vertex(mesh_, a, b, static_cast<float>(t));
    crossings_.emplace(key, fresh);
    return fresh;
  }

  Mesh& mesh_;
  std::vector<double> heights_;
  std::unordered_map<std::uint64_t, std::uint32_t> crossings_;
};

struct Outline {
  VertexLoop loop;
  Polygon projection;
  double area = 0.0;  ///< positive for a counter-clockwise outline
};

double area_of(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * sum;
}

bool contains(const Polygon& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (p.x() < x) inside = !inside;
  }
  return inside;
}

/// The boundary loops in the plane, reversed, projected as seen from below the plane.
std::vector<Outline> outlines_of(const Mesh& mesh, const Plane& plane) {
  // Cut points are interpolated in single precision: twice the tolerance.
  const double in_plane_mm = 2.0 * on_plane_distance_mm(mesh);
  const Vector3d x = plane.normal().unitOrthogonal();
  const Vector3d y = -plane.normal().cross(x);
  std::vector<Outline> outlines;
  for (const BoundaryLoop& loop : boundary_loops(mesh)) {
    Outline outline{.loop = vertices_of(mesh, loop), .projection = {}};
    const bool in_plane =
        std::all_of(outline.loop.begin(), outline.loop.end(), [&](std::uint32_t v) {
          const Vector3d position = mesh.vertices_mm[v].cast<double>();
          return std::abs(plane.signedDistance(position)) <= in_plane_mm;
        });
    if (!in_plane) continue;
    std::reverse(outline.loop.begin(), outline.loop.end());
    for (const std::uint32_t v : outline.loop) {
      const Vector3d position = mesh.vertices_mm[v].cast<double>();
      outline.projection.emplace_back(position.dot(x), position.dot(y));
    }
    outline.area = area_of(outline.projection);
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

/// The holes of each outer outline. A hole belongs to the smallest outline around it.
std::vector<std::vector<std::size_t>> holes_in(const std::vector<Outline>& outlines) {
  std::vector<std::vector<std::size_t>> holes(outlines.size());
  for (std::size_t h = 0; h < outlines.size(); ++h) {
    if (outlines[h].area > 0.0) continue;
    std::size_t owner = outlines.size();
    for (std::size_t o = 0; o < outlines.size(); ++o) {
      const bool encloses = outlines[o].area > -outlines[h].area &&
                            contains(outlines[o].projection, outlines[h].projection.front());
      if (encloses && (owner == outlines.size() || outlines[o].area < outlines[owner].area))
        owner = o;
    }
    if (owner < outlines.size()) holes[owner].push_back(h);
  }
  return holes;
}

void add_cap(Mesh& mesh,
             const std::vector<Outline>& outlines,
             std::size_t outer,
             const std::vector<std::size_t>& holes) {
  VertexLoop all = outlines[outer].loop;
  std::vector<Polygon> inner;
  for (const std::size_t hole : holes) {
    inner.push_back(outlines[hole].projection);
    all.insert(all.end(), outlines[hole].loop.begin(), outlines[hole].loop.end());
  }
  for (const auto& [a, b, c] : triangulate_polygon(outlines[outer].projection, inner))
    add_triangle(mesh, {all[a], all[b], all[c]}, Mark::Synthesized);
}

void cap(Mesh& mesh, const Plane& plane, const Run& run) {
  const std::vector<Outline> outlines = outlines_of(mesh, plane);
  const auto holes = holes_in(outlines);
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (!(outlines[i].area > 0.0)) continue;
    run.check();
    try {
      add_cap(mesh, outlines, i, holes[i]);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Numeric) throw;
      run.warn("an outline of the cut intersects itself and stays open");
    }
  }
}

}  // namespace

Mesh cut_by_plane(Mesh mesh, const Plane& plane, const CutOptions& options, const Run& run) {
  run.check();
  Cutter(mesh, plane).cut(run);
  if (options.capped) cap(mesh, plane, run);
  run.check();
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
