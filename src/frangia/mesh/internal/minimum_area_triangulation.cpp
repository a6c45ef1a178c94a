#include "frangia/mesh/internal/minimum_area_triangulation.h"

#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/Geometry>

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

}  // namespace frangia
