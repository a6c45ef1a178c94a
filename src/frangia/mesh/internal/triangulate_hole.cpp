#include "frangia/mesh/internal/triangulate_hole.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/geometry/triangulate_polygon.h"
#include "frangia/mesh/internal/hole_patch.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using PolygonTriangle = std::array<std::size_t, 3>;

constexpr std::size_t kMaxVertices = 250;  // of one search, which takes time of its cube: 10 ms
// Area of a forbidden chord per squared length: larger than any sum of real areas.
constexpr double kForbiddenPenalty = 1e6;

/// A corner that may be cut off. It is outdated once a neighbour has changed.
struct Ear {
  double chord_mm = 0.0;
  std::size_t corner = 0;
  std::uint32_t version = 0;

  bool operator<(const Ear& other) const {  // the queue pops the largest first
    return chord_mm != other.chord_mm ? chord_mm > other.chord_mm : corner > other.corner;
  }
};

/// The remaining polygon while ears are cut.
class Front {
 public:
  Front(const std::vector<Vector3d>& corners, const MinimumAreaOptions& options)
      : corners_(corners), options_(options), versions_(corners.size()) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      next_.push_back((i + 1) % corners.size());
      last_.push_back((i + corners.size() - 1) % corners.size());
    }
    for (std::size_t i = 0; i < corners.size(); ++i)
      add_ear(i);
  }

  /// Cuts ears until `until` vertices are left or no convex corner is left.
  std::vector<PolygonTriangle> shorten(std::size_t until) {
    std::vector<PolygonTriangle> cut;
    while (corners_.size() - cut.size() > until && !ears_.empty()) {
      const Ear ear = ears_.top();
      ears_.pop();
      const std::size_t i = ear.corner;
      if (ear.version != versions_[i]) continue;
      cut.push_back({last_[i], i, next_[i]});
      next_[last_[i]] = next_[i];
      last_[next_[i]] = last_[i];
      begin_ = next_[i];
      versions_[i] = kGone;
      for (const std::size_t beside : {last_[i], next_[i]}) {
        ++versions_[beside];
        add_ear(beside);
      }
    }
    return cut;
  }
  [[nodiscard]] std::vector<std::size_t> remaining() const {
    std::vector<std::size_t> line;
    for (std::size_t i = begin_; line.empty() || i != begin_; i = next_[i])
      line.push_back(i);
    return line;
  }

 private:
  static constexpr std::uint32_t kGone = 0xFFFFFFFF;

  void add_ear(std::size_t i) {
    const Vector3d in = corners_[i] - corners_[last_[i]];
    const Vector3d out = corners_[next_[i]] - corners_[i];
    if (!(in.cross(out).dot(options_.normals[i]) > 0.0)) return;
    if (options_.is_forbidden && options_.is_forbidden(last_[i], next_[i])) return;
    ears_.push({(in + out).norm(), i, versions_[i]});
  }

  const std::vector<Vector3d>& corners_;
  const MinimumAreaOptions& options_;
  std::vector<std::uint32_t> versions_;
  std::vector<std::size_t> next_, last_;
  std::size_t begin_ = 0;
  std::priority_queue<Ear> ears_;
};

/// Dynamic programming over all triangulations of a polygon.
class MinimumArea {
 public:
  MinimumArea(const std::vector<Vector3d>& corners,
              const MinimumAreaOptions& options,
              std::vector<std::size_t> line)
      : corners_(corners),
        options_(options),
        line_(std::move(line)),
        areas_(line_.size() * line_.size()),
        splits_(areas_.size()) {}

  void append_to(std::vector<PolygonTriangle>& triangles) {
    for (std::size_t width = 2; width < line_.size(); ++width) {
      for (std::size_t i = 0; i + width < line_.size(); ++i)
        choose(i, i + width);
    }
    collect(triangles, 0, line_.size() - 1);
  }

 private:
  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return i * line_.size() + j; }

  void choose(std::size_t i, std::size_t j) {
    const Vector3d& a = corners_[line_[i]];
    const Vector3d along = corners_[line_[j]] - a;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = i + 1; k < j; ++k) {
      const double own = (corners_[line_[k]] - a).cross(along).norm();
      const double area = areas_[at(i, k)] + areas_[at(k, j)] + own;
      if (area >= best) continue;
      best = area;
      splits_[at(i, j)] = k;
    }
    const bool is_whole = i == 0 && j + 1 == line_.size();
    if (!is_whole && options_.is_forbidden && options_.is_forbidden(line_[i], line_[j])) {
      best += kForbiddenPenalty * along.squaredNorm();
    }
    areas_[at(i, j)] = best;
  }

  void collect(std::vector<PolygonTriangle>& triangles, std::size_t i, std::size_t j) const {
    if (j < i + 2) return;
    const std::size_t k = splits_[at(i, j)];
    triangles.push_back({line_[i], line_[k], line_[j]});
    collect(triangles, i, k);
    collect(triangles, k, j);
  }

  const std::vector<Vector3d>& corners_;
  const MinimumAreaOptions& options_;
  std::vector<std::size_t> line_;
  std::vector<double> areas_;
  std::vector<std::size_t> splits_;
};

/// Divides a long polygon into runs of vertices: triangulates each run with its chord, and the
/// polygon of the chords.
void triangulate(const std::vector<Vector3d>& corners,
                 const MinimumAreaOptions& options,
                 const std::vector<std::size_t>& line,
                 std::vector<PolygonTriangle>& triangles,
                 const Run& run) {
  if (line.size() < 3) return;
  run.check();
  if (line.size() <= kMaxVertices) {
    MinimumArea(corners, options, line).append_to(triangles);
    return;
  }
  const std::size_t run_length = (line.size() + kMaxVertices - 1) / kMaxVertices;
  std::vector<std::size_t> ends;
  for (std::size_t begin = 0; begin < line.size(); begin += run_length) {
    ends.push_back(line[begin]);
    std::vector<std::size_t> part;
    for (std::size_t i = begin; i <= std::min(begin + run_length, line.size()); ++i)
      part.push_back(line[i % line.size()]);
    triangulate(corners, options, part, triangles, run);
  }
  triangulate(corners, options, ends, triangles, run);
}

}  // namespace

std::vector<std::array<std::size_t, 3>> minimum_area_triangulation(
    const std::vector<Vector3d>& corners_mm, const MinimumAreaOptions& options, const Run& run) {
  if (corners_mm.size() < 3) return {};
  std::vector<PolygonTriangle> triangles;
  std::vector<std::size_t> line;
  if (options.normals.size() == corners_mm.size()) {
    Front front(corners_mm, options);
    triangles = front.shorten(kMaxVertices);
    line = front.remaining();
  } else {
    for (std::size_t i = 0; i < corners_mm.size(); ++i)
      line.push_back(i);
  }
  triangulate(corners_mm, options, line, triangles, run);
  return triangles;
}

namespace {

using Eigen::Vector3d;
using VertexLoop = std::vector<std::uint32_t>;

// Longer boundaries are triangulated in projection, which takes less than the cube of the length.
constexpr std::size_t kMaxByArea = 100;

Vector3d position(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices_mm[vertex].cast<double>();
}

/// The normal of the plane on which the projected area of a polygon is largest.
Vector3d normal_of_polygon(const std::vector<Vector3d>& line) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 0; i < line.size(); ++i)
    normal += (line[i] - line.front()).cross(line[(i + 1) % line.size()] - line.front());
  return normal;
}

std::vector<Mesh::Triangle> minimum_area(const std::vector<Vector3d>& line,
                                         const VertexLoop& loop) {
  std::vector<Mesh::Triangle> triangles;
  const MinimumAreaOptions options{.normals = {line.size(), normal_of_polygon(line)},
                                   .is_forbidden = {}};
  for (const auto& [a, b, c] : minimum_area_triangulation(line, options))
    triangles.push_back({loop[a], loop[b], loop[c]});
  return triangles;
}

/// Triangulates the projection of a polygon on its plane; empty when it intersects itself.
std::vector<Mesh::Triangle> triangulate_projection(const std::vector<Vector3d>& line,
                                                   const VertexLoop& loop) {
  const Vector3d normal = normal_of_polygon(line);
  const Vector3d x = normal.unitOrthogonal();
  const Vector3d y = normal.normalized().cross(x);
  Polygon projection;
  for (const Vector3d& corner : line) {
    const Vector3d away = corner - line.front();
    projection.emplace_back(away.dot(x), away.dot(y));
  }
  std::vector<Mesh::Triangle> triangles;
  try {
    for (const auto& [a, b, c] : triangulate_polygon(projection))
      triangles.push_back({loop[a], loop[b], loop[c]});
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Numeric) throw;
    triangles.clear();
  }
  return triangles;
}

}  // namespace

HolePatch flat_patch(const Mesh& mesh, const VertexLoop& boundary) {
  HolePatch patch;
  if (boundary.size() < 3) return patch;
  const VertexLoop loop(boundary.rbegin(),
                        boundary.rend());  // the patch has the opposite direction
  std::vector<Vector3d> line;
  for (const std::uint32_t vertex : loop)
    line.push_back(position(mesh, vertex));
  if (loop.size() > kMaxByArea) patch.triangles = triangulate_projection(line, loop);
  if (patch.triangles.empty()) patch.triangles = minimum_area(line, loop);
  return patch;
}

HolePatch fan_patch(const Mesh& mesh, const std::vector<std::uint32_t>& loop) {
  HolePatch patch;
  Vector3d mean = Vector3d::Zero();
  for (const std::uint32_t vertex : loop)
    mean += position(mesh, vertex);
  patch.positions_mm.emplace_back((mean / static_cast<double>(loop.size())).cast<float>());
  const auto middle = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < loop.size(); ++i)
    patch.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], middle});
  return patch;
}

}  // namespace frangia
