#include "frangia/mesh/internal/minimum_area_triangulation.h"

#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/Geometry>

namespace frangia {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::size_t, 3>;

constexpr std::size_t kMostAtOnce = 250;   // the search takes the cube of it
constexpr double kForbiddenPenalty = 1e6;  // an area, in squares of a length

/// A corner that may be cut off. Out of date once a neighbour has changed since.
struct Ear {
  double chord_mm = 0.0;
  std::size_t corner = 0;
  std::uint32_t version = 0;

  bool operator<(const Ear& other) const {  // the queue gives the largest first
    return chord_mm != other.chord_mm ? chord_mm > other.chord_mm : corner > other.corner;
  }
};

/// The line, from which corners are cut.
class Front {
 public:
  Front(const std::vector<Vector3d>& corners, const MinimumAreaOptions& options)
      : corners_(corners), options_(options), versions_(corners.size()) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      next_.push_back((i + 1) % corners.size());
      last_.push_back((i + corners.size() - 1) % corners.size());
    }
    for (std::size_t i = 0; i < corners.size(); ++i)
      look_at(i);
  }

  /// Cuts corners until so many are left, or none points inwards.
  std::vector<Triangle> shorten(std::size_t until) {
    std::vector<Triangle> cut;
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
        look_at(beside);
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

  void look_at(std::size_t i) {
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

/// The filling of a line of least area.
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

  void append_to(std::vector<Triangle>& triangles) {
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
    const bool whole = i == 0 && j + 1 == line_.size();
    if (!whole && options_.is_forbidden && options_.is_forbidden(line_[i], line_[j])) {
      best += kForbiddenPenalty * along.squaredNorm();
    }
    areas_[at(i, j)] = best;
  }

  void collect(std::vector<Triangle>& triangles, std::size_t i, std::size_t j) const {
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

/// Fills lines that are still too long by halves: what their ends enclose, and each with its chord.
void fill(const std::vector<Vector3d>& corners,
          const MinimumAreaOptions& options,
          const std::vector<std::size_t>& line,
          std::vector<Triangle>& triangles) {
  if (line.size() < 3) return;
  if (line.size() <= kMostAtOnce) {
    MinimumArea(corners, options, line).append_to(triangles);
    return;
  }
  const std::size_t run = (line.size() + kMostAtOnce - 1) / kMostAtOnce;
  std::vector<std::size_t> ends;
  for (std::size_t begin = 0; begin < line.size(); begin += run) {
    ends.push_back(line[begin]);
    std::vector<std::size_t> some;
    for (std::size_t i = begin; i <= std::min(begin + run, line.size()); ++i)
      some.push_back(line[i % line.size()]);
    fill(corners, options, some, triangles);
  }
  fill(corners, options, ends, triangles);
}

}  // namespace

std::vector<std::array<std::size_t, 3>> minimum_area_triangulation(
    const std::vector<Vector3d>& corners_mm, const MinimumAreaOptions& options) {
  if (corners_mm.size() < 3) return {};
  std::vector<Triangle> triangles;
  std::vector<std::size_t> line;
  if (options.normals.size() == corners_mm.size()) {
    Front front(corners_mm, options);
    triangles = front.shorten(kMostAtOnce);
    line = front.remaining();
  } else {
    for (std::size_t i = 0; i < corners_mm.size(); ++i)
      line.push_back(i);
  }
  fill(corners_mm, options, line, triangles);
  return triangles;
}

}  // namespace frangia
