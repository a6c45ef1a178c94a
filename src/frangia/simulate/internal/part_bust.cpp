#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "frangia/simulate/internal/polygonize_field.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

/// Signed distances of simple solids, negative inside, and ways to blend them. Lengths in mm.
///
/// @source   Inigo Quilez, "distance functions" and "smooth minimum"
using Position = Eigen::Vector3d;

double ball(const Position& p, const Position& center, double radius) {
  return (p - center).norm() - radius;
}

/// First-order approximation: exact on the surface.
double ellipsoid(const Position& p, const Position& center, const Position& radii) {
  const Position q = (p - center).cwiseQuotient(radii);
  const double k0 = q.norm();
  const double k1 = q.cwiseQuotient(radii).norm();
  return k1 > 1e-9 ? k0 * (k0 - 1.0) / k1 : -radii.minCoeff();
}

/// A rod with round ends whose radius changes linearly along it.
struct Rod {
  Position from, to;
  double from_radius, to_radius;
};

double rod(const Position& p, const Rod& rod) {
  const Position along = rod.to - rod.from;
  const double t = std::clamp((p - rod.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - rod.from - t * along).norm() -
         (rod.from_radius + t * (rod.to_radius - rod.from_radius));
}

/// A disc on the z axis with rounded edges.
struct Disc {
  double low, high, radius, rounding;
};

double disc(const Position& p, const Disc& disc) {
  const double out = std::hypot(p.x(), p.y()) - disc.radius + disc.rounding;
  const double up =
      std::abs(p.z() - 0.5 * (disc.low + disc.high)) - 0.5 * (disc.high - disc.low) + disc.rounding;
  return std::min(std::max(out, up), 0.0) + std::hypot(std::max(out, 0.0), std::max(up, 0.0)) -
         disc.rounding;
}

/// The union of two solids with a fillet of about `width` between them.
double smooth_union(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * h * h;
}

/// The first solid without the second, the edge rounded over about `width`.
double smooth_difference(double a, double b, double width) {
  return -smooth_union(-a, b, width);
}

/// The intersection of two solids, the edge rounded over about `width`.
double smooth_intersection(double a, double b, double width) {
  return -smooth_union(-a, -b, width);
}

// The face looks along +x. What lies left and right is modelled once, at y >= 0, for both sides.

double skull(const Position& p) {
  double d = ellipsoid(p, {-2.5, 0, 91.5}, {18.5, 15.2, 16.5});
  d = smooth_union(d, ellipsoid(p, {4.0, 0, 80.5}, {12.5, 11.8, 17.0}), 5.0);
  d = smooth_union(d, rod(p, {{-3, 10.2, 76}, {10, 4.2, 67}, 3.2, 3.2}), 6.0);  // jaw
  d = smooth_union(d, ball(p, {13.4, 0, 66.0}, 4.0), 4.0);                      // chin
  return smooth_union(d, ball(p, {10.6, 7.8, 78.2}, 3.4), 4.0);                 // cheek
}

double eyes(const Position& p, double head) {
  const double sockets = ellipsoid(p, {18.6, 6.2, 83.6}, {4.6, 4.4, 3.1});
  double d = smooth_difference(head, sockets, 2.6);
  d = smooth_union(d, ball(p, {12.2, 6.0, 83.4}, 3.5), 0.6);
  // Lids: a shell over the eyeball with the opening between them cut away.
  const double shell = ball(p, {12.3, 6.0, 83.4}, 4.0);
  const double opening = ellipsoid(p, {16.4, 6.0, 83.1}, {3.0, 3.1, 1.25});
  d = smooth_union(d, smooth_difference(shell, opening, 0.4), 0.7);
  return smooth_union(d, rod(p, {{16.4, 2.4, 87.0}, {12.6, 9.6, 87.6}, 1.5, 1.1}), 2.6);  // brow
}

double nose(const Position& p) {
  double d = rod(p, {{15.4, 0, 86.5}, {20.0, 0, 77.4}, 1.5, 1.9});
  d = smooth_union(d, ball(p, {17.9, 2.3, 76.8}, 1.5), 1.4);
  return smooth_difference(d, ball(p, {18.6, 1.5, 75.1}, 0.7), 0.6);
}

double mouth(const Position& p, double head) {
  double d = smooth_union(head, rod(p, {{16.0, 0.8, 72.5}, {13.4, 4.4, 71.3}, 1.5, 0.8}), 1.0);
  d = smooth_union(d, rod(p, {{15.7, 0, 69.7}, {13.4, 3.7, 70.6}, 1.7, 0.9}), 1.0);
  return smooth_difference(d, rod(p, {{17.9, 0, 71.2}, {14.4, 5.0, 70.9}, 0.5, 0.25}), 0.8);
}

double ear(const Position& p) {
  // In the ear's own frame: leaning back and standing off the head.
  const Position q = p - Position(-2.6, 15.4, 81.8);
  const Position r(q.x() + 0.22 * q.z() + 0.35 * q.y(), q.y() + 0.38 * q.x(), q.z());
  double d = ellipsoid(r, {0, 0, 0}, {4.2, 1.9, 6.6});
  d = smooth_difference(d, ellipsoid(r, {0.9, 1.7, 0.9}, {2.6, 1.7, 4.4}), 0.8);
  return smooth_union(d, ball(r, {2.6, 0.6, -0.6}, 0.9), 0.8);
}

/// Locks of hair: waves on a cap, from the brow over the crown down to the nape.
double hair(const Position& p) {
  const double waves = 0.75 * std::sin(0.62 * p.z() + 1.1 * std::sin(0.35 * p.y() + 0.2 * p.x())) *
                       std::cos(0.5 * p.y() - 0.33 * p.x());
  const double cap = ellipsoid(p, {-3.6, 0, 92.0}, {19.6, 16.8, 17.6}) - waves;
  const double line = 74.0 + 1.15 * std::max(p.x() + 6.0, 0.0);  // hairline: nape, temple, brow
  return 0.8 * smooth_intersection(cap, 0.72 * (line - p.z()), 2.0);
}

double neck_and_shoulders(const Position& p) {
  double d = rod(p, {{-4.0, 0, 50}, {-3.0, 0, 74}, 9.6, 9.2});
  d = smooth_union(
      d, rod(p, {{-4.5, 8.6, 73}, {5.0, 2.2, 52}, 1.8, 1.6}), 3.0);  // neck's long muscle
  d = smooth_union(d, ball(p, {6.0, 0, 62.2}, 1.2), 3.5);            // larynx
  d = smooth_union(d, rod(p, {{-6.0, 6, 58}, {-4.5, 29, 45}, 6.0, 7.5}), 9.0);        // trapezius
  d = smooth_union(d, ellipsoid(p, {-2.0, 0, 39.0}, {13.5, 31.0, 16.0}), 7.0);        // chest
  d = smooth_union(d, ball(p, {-3.0, 32.0, 41.5}, 9.5), 6.0);                         // shoulder
  d = smooth_union(d, ellipsoid(p, {5.6, 11.5, 37.5}, {7.0, 11.5, 8.5}), 4.0);        // pectoral
  d = smooth_union(d, rod(p, {{6.4, 3.0, 50.0}, {1.0, 27.0, 50.4}, 1.3, 1.2}), 3.2);  // collar bone
  // Cut in a sweep from the arms down to the socle, as busts are.
  const double sweep = 23.0 + 0.011 * p.y() * p.y() - p.z();
  d = smooth_intersection(d, 0.8 * sweep, 2.5);
  return smooth_intersection(d, p.y() - 37.5, 3.0);
}

double socle(const Position& p) {
  double d = disc(p, {0.0, 7.0, 23.0, 1.4});
  const double height = (p.z() - 13.0) / 8.0;
  d = smooth_union(d,
                   0.9 * std::max(std::hypot(p.x(), p.y()) - 11.0 - 4.0 * height * height,
                                  std::abs(p.z() - 13.0) - 8.0),
                   1.5);
  return smooth_union(d, disc(p, {19.5, 24.0, 16.5, 1.2}), 1.0);
}

double bust(const Position& place) {
  const Position p(place.x(), std::abs(place.y()), place.z());
  double d = skull(p);
  d = eyes(p, d);
  d = smooth_union(d, nose(p), 1.8);
  d = mouth(p, d);
  d = smooth_union(d, ear(p), 1.2);
  d = smooth_union(d, hair(p), 0.8);
  d = smooth_union(d, neck_and_shoulders(p), 4.0);
  return smooth_union(d, socle(place), 1.5);
}

}  // namespace

Mesh make_bust(const Run& run) {
  const Eigen::AlignedBox3d box(Position(-32.0, -44.0, -1.3), Position(32.0, 44.0, 112.0));
  return polygonize_field(bust, box, 0.55, run);
}

}  // namespace frangia
