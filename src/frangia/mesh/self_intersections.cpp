#include "frangia/mesh/self_intersections.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/mesh/boundary_loops.h"
#include "frangia/mesh/box_tree.h"
#include "frangia/mesh/change_selection.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/triangles_cross.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

constexpr std::size_t kChunk = 2048;  // leaves

CornerPlaces corners_of(const Mesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {t,
          {mesh.vertices_mm[t[0]].cast<double>(),
           mesh.vertices_mm[t[1]].cast<double>(),
           mesh.vertices_mm[t[2]].cast<double>()}};
}

bool has(const CornerPlaces& t, std::uint32_t vertex) {
  return std::find(t.vertices.begin(), t.vertices.end(), vertex) != t.vertices.end();
}

/// Whether a certain gap parts the two: all corners of one that are not shared lie surely on the
/// same side of the other's plane. Coordinates are floats, sums are of doubles: far beyond the
/// error of rounding.
bool parted_by_plane(const CornerPlaces& plane, const CornerPlaces& other) {
  const Vector3d& origin = plane.places_mm[0];
  const Vector3d u = plane.places_mm[1] - origin;
  const Vector3d v = plane.places_mm[2] - origin;
  const Vector3d normal = u.cross(v);
  int above = 0;
  int below = 0;
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (has(plane, other.vertices.at(i))) continue;
    const Vector3d way = other.places_mm.at(i) - origin;
    const double height = normal.dot(way);
    const double doubt = 1e-13 * u.norm() * v.norm() * way.norm();
    ++count;
    if (height > doubt) ++above;
    if (height < -doubt) ++below;
  }
  return count > 0 && (above == count || below == count);
}

/// The same for lines: seen along the axis that shows `a` best, an edge of it has all of b beyond.
bool parted_by_edge(const CornerPlaces& a, const CornerPlaces& b) {
  const Vector3d normal = (a.places_mm[1] - a.places_mm[0]).cross(a.places_mm[2] - a.places_mm[0]);
  Eigen::Index dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  const Eigen::Index x = (dropped + 1) % 3;
  const Eigen::Index y = (dropped + 2) % 3;
  const double turn = normal[dropped] > 0.0 ? 1.0 : -1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& from = a.places_mm.at(i);
    const Vector3d along = a.places_mm.at((i + 1) % 3) - from;
    const bool shared_from = has(b, a.vertices.at(i));
    const bool shared_to = has(b, a.vertices.at((i + 1) % 3));
    int beyond = 0;
    int count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool on_line = (shared_from && b.vertices.at(k) == a.vertices.at(i)) ||
                           (shared_to && b.vertices.at(k) == a.vertices.at((i + 1) % 3));
      if (on_line) continue;
      const Vector3d way = b.places_mm.at(k) - from;
      const double side = turn * (along[x] * way[y] - along[y] * way[x]);
      ++count;
      if (side < -1e-13 * along.norm() * way.norm()) ++beyond;
    }
    if (count > 0 && beyond == count) return true;
  }
  return false;
}

bool cross(const CornerPlaces& a, const CornerPlaces& b) {
  if (parted_by_plane(a, b) || parted_by_plane(b, a)) return false;
  if (parted_by_edge(a, b) || parted_by_edge(b, a)) return false;
  return triangles_cross(a, b);
}

/// For each vertex that is left after deleting: whether something at it went.
std::vector<std::uint8_t> rim_after_deleting(const Mesh& mesh, const Selection& going) {
  std::vector<std::uint8_t> stays(mesh.vertices_mm.size());
  std::vector<std::uint8_t> touched(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < going.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i])
      (going[i] != 0 ? touched : stays)[vertex] = 1;
  }
  std::vector<std::uint8_t> rim;
  for (std::size_t v = 0; v < stays.size(); ++v)
    if (stays[v] != 0) rim.push_back(touched[v]);
  return rim;
}

Mesh close_loops_at(Mesh mesh, const std::vector<std::uint8_t>& rim, const Run& run) {
  FillHolesOptions options{.kind = HoleFill::Flat};
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto vertices = vertices_of(mesh, loops[i]);
    const bool touched = std::any_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) {
      return v < rim.size() && rim[v] != 0;
    });
    if (touched) options.only.push_back(i);
  }
  return options.only.empty() ? mesh : fill_holes(std::move(mesh), options, run);
}

}  // namespace

Pairs self_intersections(const Mesh& mesh, const Run& run) {
  const BoxTree tree(mesh);
  const std::size_t count = tree.leaves();
  std::vector<Pairs> found((count + kChunk - 1) / kChunk);
  parallel_chunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
    Pairs& pairs = found[begin / kChunk];
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      tree.touching_pairs(leaf, [&](std::uint32_t a, std::uint32_t b) {
        if (cross(corners_of(mesh, a), corners_of(mesh, b))) {
          pairs.emplace_back(std::min(a, b), std::max(a, b));
        }
      });
    }
  });
  run.check();
  Pairs all;
  for (const Pairs& some : found)
    all.insert(all.end(), some.begin(), some.end());
  std::sort(all.begin(), all.end());
  return all;
}

Selection select_self_intersections(const Mesh& mesh, const Run& run) {
  Selection selection(mesh.triangles.size());
  for (const auto& pair : self_intersections(mesh, run))
    selection[pair.first] = selection[pair.second] = 1;
  return selection;
}

Mesh remove_self_intersections(Mesh mesh, const Run& run) {
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    Selection crossing = select_self_intersections(mesh, run);
    if (count_of(crossing) == 0) return mesh;
    crossing = grow_selection(mesh, std::move(crossing), round);
    const std::vector<std::uint8_t> rim = rim_after_deleting(mesh, crossing);
    mesh = make_manifold(delete_selected(std::move(mesh), crossing));
    mesh = close_loops_at(std::move(mesh), rim, run);
    run.report((round + 1.0) / kRounds);
  }
  const std::size_t left = count_of(select_self_intersections(mesh, run));
  if (left > 0) {
    run.warn("some triangles cross still; remove them by hand and fill the holes they leave");
  }
  return mesh;
}

}  // namespace frangia
