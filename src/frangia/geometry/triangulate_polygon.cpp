#include "frangia/geometry/triangulate_polygon.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include "frangia/core/error.h"

namespace frangia {
namespace {

using Point = Eigen::Vector2d;
using Ring = std::vector<std::size_t>;

/// Returns twice the signed area of a, b, c: positive for a left turn.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// A turn below this is rounding. The points are scaled to a bounding box with a diagonal of 1.
constexpr double kFlat = 1e-12;

/// Whether the open segments p-q and a-b intersect, or an end of one lies inside the other.
bool crosses(const Point& p, const Point& q, const Point& a, const Point& b) {
  if (a == p || a == q || b == p || b == q) return false;
  const double ta = turn(p, q, a);
  const double tb = turn(p, q, b);
  const double tp = turn(a, b, p);
  const double tq = turn(a, b, q);
  const bool apart = (ta > kFlat && tb > kFlat) || (ta < -kFlat && tb < -kFlat) ||
                     (tp > kFlat && tq > kFlat) || (tp < -kFlat && tq < -kFlat);
  const bool collinear = std::abs(ta) <= kFlat && std::abs(tb) <= kFlat;
  if (collinear) {
    const Point along = q - p;
    const double length2 = along.squaredNorm();
    const double sa = (a - p).dot(along);
    const double sb = (b - p).dot(along);
    return std::max(sa, sb) > 0.0 && std::min(sa, sb) < length2;
  }
  return !apart;
}

struct Clipper {
  std::vector<Point> points;
  Ring ring;
  std::vector<std::array<std::size_t, 3>> triangles;

  [[nodiscard]] const Point& at(std::size_t place) const {
    return points[ring[place % ring.size()]];
  }

  /// Whether the segment from the ring's corner to q starts inside the polygon.
  [[nodiscard]] bool opens_towards(std::size_t place, const Point& q) const {
    const Point& before = at(place + ring.size() - 1);
    const Point& here = at(place);
    const Point& after = at(place + 1);
    const bool left_of_after = turn(here, after, q) > kFlat;
    const bool left_of_before = turn(before, here, q) > kFlat;
    return turn(before, here, after) >= 0.0 ? left_of_after && left_of_before
                                            : left_of_after || left_of_before;
  }

  [[nodiscard]] bool bridge_is_free(const Point& p, const Point& q, const Ring& loop) const {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (crosses(p, q, points[loop[i]], points[loop[(i + 1) % loop.size()]])) return false;
    }
    return true;
  }

  /// Joins a hole to the boundary by a bridge from its rightmost point to the nearest visible
  /// corner.
  void join(const Ring& hole, const std::vector<Ring>& holes_left) {
    const auto start =
        static_cast<std::size_t>(std::max_element(hole.begin(),
                                                  hole.end(),
                                                  [&](std::size_t a, std::size_t b) {
                                                    return points[a].x() < points[b].x();
                                                  }) -
                                 hole.begin());
    const Point from = points[hole[start]];
    Ring order(ring.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return (at(a) - from).squaredNorm() < (at(b) - from).squaredNorm();
    });
    for (const std::size_t place : order) {
      const Point& to = at(place);
      bool free = opens_towards(place, from) && bridge_is_free(from, to, ring) &&
                  bridge_is_free(from, to, hole);
      for (const Ring& other : holes_left)
        free = free && bridge_is_free(from, to, other);
      if (!free) continue;
      Ring detour(hole.begin() + static_cast<std::ptrdiff_t>(start), hole.end());
      detour.insert(
          detour.end(), hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(start) + 1);
      detour.push_back(ring[place]);
      ring.insert(
          ring.begin() + static_cast<std::ptrdiff_t>(place) + 1, detour.begin(), detour.end());
      return;
    }
    throw Error(ErrorKind::Numeric,
                "triangulate_polygon: a hole lies outside the boundary or crosses it");
  }

  [[nodiscard]] bool is_ear(std::size_t place) const {
    const Point& a = at(place + ring.size() - 1);
    const Point& b = at(place);
    const Point& c = at(place + 1);
    if (turn(a, b, c) <= kFlat) return false;
    return std::none_of(ring.begin(), ring.end(), [&](std::size_t index) {
      const Point& p = points[index];
      if (p == a || p == b || p == c) return false;
      return turn(a, b, p) >= -kFlat && turn(b, c, p) >= -kFlat && turn(c, a, p) >= -kFlat;
    });
  }

  [[noreturn]] static void fail() {
    throw Error(ErrorKind::Numeric,
                "triangulate_polygon: the polygon crosses itself or runs clockwise");
  }

  void clip() {
    std::size_t place = 0;
    std::size_t refused = 0;
    while (ring.size() > 3) {
      place %= ring.size();
      if (!is_ear(place)) {
        if (++refused > ring.size()) fail();
        ++place;
        continue;
      }
      refused = 0;
      triangles.push_back({ring[(place + ring.size() - 1) % ring.size()],
                           ring[place],
                           ring[(place + 1) % ring.size()]});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(place));
      ++place;  // skips a corner, so that the triangles do not form a single fan
    }
    if (turn(at(0), at(1), at(2)) < -kFlat) fail();
    triangles.push_back({ring[0], ring[1], ring[2]});
  }
};

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate_polygon(const Polygon& outer,
                                                            const std::vector<Polygon>& holes) {
  require(outer.size() >= 3, "triangulate_polygon: a polygon needs at least three points");
  Clipper clipper;
  clipper.points = outer;
  clipper.ring.resize(outer.size());
  std::iota(clipper.ring.begin(), clipper.ring.end(), std::size_t{0});
  std::vector<Ring> rings;
  for (const Polygon& hole : holes) {
    Ring ring(hole.size());
    std::iota(ring.begin(), ring.end(), clipper.points.size());
    clipper.points.insert(clipper.points.end(), hole.begin(), hole.end());
    rings.push_back(std::move(ring));
  }
  Eigen::AlignedBox2d box;
  for (const Point& point : clipper.points)
    box.extend(point);
  const double size = box.diagonal().norm();
  for (Point& point : clipper.points)
    point /= size > 0.0 ? size : 1.0;
  // Nothing lies between the rightmost hole's rightmost point and the boundary.
  const auto reach = [&](const Ring& ring) {
    double right = clipper.points[ring.front()].x();
    for (const std::size_t i : ring)
      right = std::max(right, clipper.points[i].x());
    return right;
  };
  std::stable_sort(rings.begin(), rings.end(), [&](const Ring& a, const Ring& b) {
    return reach(a) < reach(b);
  });
  while (!rings.empty()) {
    const Ring hole = std::move(rings.back());
    rings.pop_back();
    clipper.join(hole, rings);
  }
  clipper.clip();
  return std::move(clipper.triangles);
}

}  // namespace frangia
