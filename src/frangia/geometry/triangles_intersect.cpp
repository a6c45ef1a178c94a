// The only source of this module that includes CGAL, which is slow to compile.
#include "frangia/geometry/triangles_intersect.h"

#include "frangia/core/error.h"

#ifdef FRANGIA_WITH_CGAL
#include <algorithm>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

namespace frangia {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point point_of(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

Kernel::Triangle_3 triangle_of(const IndexedTriangle& t) {
  return {point_of(t.corners_mm[0]), point_of(t.corners_mm[1]), point_of(t.corners_mm[2])};
}

/// Returns for each corner of `a` whether it is a vertex of `b`.
std::array<bool, 3> shared_of(const IndexedTriangle& a, const IndexedTriangle& b) {
  std::array<bool, 3> shared{};
  for (std::size_t i = 0; i < 3; ++i) {
    shared.at(i) =
        std::find(b.vertices.begin(), b.vertices.end(), a.vertices.at(i)) != b.vertices.end();
  }
  return shared;
}

std::size_t index_of(const std::array<bool, 3>& flags, bool value) {
  return static_cast<std::size_t>(std::find(flags.begin(), flags.end(), value) - flags.begin());
}

Kernel::Segment_3 opposite(const IndexedTriangle& t, std::size_t corner) {
  return {point_of(t.corners_mm.at((corner + 1) % 3)), point_of(t.corners_mm.at((corner + 2) % 3))};
}

/// Two triangles with a common edge overlap when they are coplanar and on the same side of it.
bool overlap_at_edge(const IndexedTriangle& a,
                     std::size_t far_a,
                     const IndexedTriangle& b,
                     std::size_t far_b) {
  const Point p = point_of(a.corners_mm.at((far_a + 1) % 3));
  const Point q = point_of(a.corners_mm.at((far_a + 2) % 3));
  const Point ra = point_of(a.corners_mm.at(far_a));
  const Point rb = point_of(b.corners_mm.at(far_b));
  return CGAL::orientation(p, q, ra, rb) == CGAL::COPLANAR &&
         CGAL::coplanar_orientation(p, q, ra, rb) == CGAL::POSITIVE;
}

}  // namespace

bool can_test_intersections() {
  return true;
}

bool triangles_intersect(const IndexedTriangle& a, const IndexedTriangle& b) {
  const auto in_b = shared_of(a, b);
  const auto in_a = shared_of(b, a);
  const Kernel::Triangle_3 ta = triangle_of(a);
  const Kernel::Triangle_3 tb = triangle_of(b);
  if (ta.is_degenerate() || tb.is_degenerate()) return false;
  switch (std::count(in_b.begin(), in_b.end(), true)) {
    case 0:
      return CGAL::do_intersect(ta, tb);
    case 1:
      return CGAL::do_intersect(opposite(a, index_of(in_b, true)), tb) ||
             CGAL::do_intersect(opposite(b, index_of(in_a, true)), ta);
    case 2:
      return overlap_at_edge(a, index_of(in_b, false), b, index_of(in_a, false));
    default:
      return true;
  }
}

}  // namespace frangia
#else
namespace frangia {

bool can_test_intersections() {
  return false;
}

bool triangles_intersect(const IndexedTriangle& /*a*/, const IndexedTriangle& /*b*/) {
  throw Error(ErrorKind::Input,
              "this build has no exact intersection test: configure it with FRANGIA_CGAL=ON");
}

}  // namespace frangia
#endif
