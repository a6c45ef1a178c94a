#include "frangia/fusion/internal/cell_loops.h"

#include <cstddef>

namespace frangia {
namespace {

/// Returns the edge between two neighbouring corners.
int edge_between(int one, int other) {
  const int low = one < other ? one : other;
  const int across = one ^ other;
  const int axis = across == 1 ? 0 : across == 2 ? 1 : 2;
  return 4 * axis + (low >> ((axis + 1) % 3) & 1) + 2 * (low >> ((axis + 2) % 3) & 1);
}

/// Returns the corners of a face in cyclic order.
std::array<int, 4> face_ring(int face) {
  const int axis = face / 2;
  const int base = (face & 1) << axis;
  const int b = 1 << ((axis + 1) % 3);
  const int c = 1 << ((axis + 2) % 3);
  return {base, base | b, base | b | c, base | c};
}

/// For each crossed edge, the edges it is connected to across its two faces.
struct EdgeLinks {
  std::array<std::array<int, 2>, 12> to{};
  std::array<int, 12> count{};

  void join(int one, int other) {
    to[static_cast<std::size_t>(one)]
      [static_cast<std::size_t>(count[static_cast<std::size_t>(one)]++)] = other;
    to[static_cast<std::size_t>(other)]
      [static_cast<std::size_t>(count[static_cast<std::size_t>(other)]++)] = one;
  }
};

EdgeLinks edge_links_of(unsigned inside) {
  EdgeLinks links;
  for (int face = 0; face < 6; ++face) {
    const auto ring = face_ring(face);
    std::array<int, 4> crossed{};
    int crossings = 0;
    const auto is_inside = [&](std::size_t i) { return (inside >> ring[i % 4] & 1U) != 0; };
    // Edge i of the ring lies between its corners i and i + 1.
    const auto edge = [&](std::size_t i) { return edge_between(ring[i % 4], ring[(i + 1) % 4]); };
    for (std::size_t i = 0; i < 4; ++i) {
      if (is_inside(i) != is_inside(i + 1))
        crossed[static_cast<std::size_t>(crossings++)] = edge(i);
    }
    if (crossings == 2) links.join(crossed[0], crossed[1]);
    if (crossings < 4) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      if (is_inside(i)) links.join(edge(i + 3), edge(i));
    }
  }
  return links;
}

CellLoops loops_of(unsigned inside) {
  const EdgeLinks links = edge_links_of(inside);
  CellLoops loops;
  loops.loop_of_edge.fill(CellLoops::kNone);
  for (std::size_t start = 0; start < 12; ++start) {
    if (links.count[start] == 0 || loops.loop_of_edge[start] != CellLoops::kNone) continue;
    std::size_t edge = start;
    while (loops.loop_of_edge[edge] == CellLoops::kNone) {
      loops.loop_of_edge[edge] = loops.count;
      const auto next = static_cast<std::size_t>(links.to[edge][0]);
      const bool taken = loops.loop_of_edge[next] != CellLoops::kNone;
      edge = taken ? static_cast<std::size_t>(links.to[edge][1]) : next;
    }
    ++loops.count;
  }
  for (int face = 0; face < 6; ++face) {
    const auto ring = face_ring(face);
    bool one_loop = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto edge = static_cast<std::size_t>(edge_between(ring[i], ring[(i + 1) % 4]));
      const auto first = static_cast<std::size_t>(edge_between(ring[0], ring[1]));
      one_loop = one_loop && loops.loop_of_edge[edge] != CellLoops::kNone &&
                 loops.loop_of_edge[edge] == loops.loop_of_edge[first];
    }
    if (one_loop)
      loops.pinched_faces |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(face));
  }
  return loops;
}

}  // namespace

const std::array<CellLoops, 256>& cell_loops() {
  static const std::array<CellLoops, 256> table = [] {
    std::array<CellLoops, 256> all{};
    for (unsigned inside = 0; inside < 256; ++inside)
      all[inside] = loops_of(inside);
    return all;
  }();
  return table;
}

}  // namespace frangia
