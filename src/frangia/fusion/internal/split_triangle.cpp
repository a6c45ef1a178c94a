#include "frangia/fusion/internal/split_triangle.h"

#include <bit>

namespace frangia {
namespace {

void add(SplitTriangle& t, std::size_t a, std::size_t b, std::size_t c) {
  t.pieces[t.count++] = {
      static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c)};
}

/// Cuts off the corner between two points, and the remaining quad along its shorter diagonal.
void cut_corner(SplitTriangle& t, std::size_t corner) {
  const std::size_t next = (corner + 1) % 3;
  const std::size_t last = (corner + 2) % 3;
  const std::size_t after = 3 + corner;
  const std::size_t before = 3 + last;
  add(t, before, corner, after);
  const float one = (t.points[last] - t.points[after]).squaredNorm();
  const float other = (t.points[next] - t.points[before]).squaredNorm();
  if (one < other) {
    add(t, last, before, after);
    add(t, last, after, next);
  } else {
    add(t, last, before, next);
    add(t, next, before, after);
  }
}

}  // namespace

void triangulate(SplitTriangle& t) {
  t.count = 0;
  if (t.split == 0) return add(t, 0, 1, 2);
  const int points = std::popcount(t.split);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const std::size_t last = (i + 2) % 3;
    const bool here = (t.split >> i & 1U) != 0;
    if (points == 1 && here) {
      add(t, i, 3 + i, last);
      add(t, 3 + i, next, last);
    }
    if (points == 2 && !here) cut_corner(t, last);
    if (points == 3) {
      add(t, 6, i, 3 + i);
      add(t, 6, 3 + i, next);
    }
  }
}

}  // namespace frangia
