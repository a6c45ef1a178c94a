#include "frangia/fusion/internal/remove_slivers.h"

#include <algorithm>

#include "frangia/fusion/internal/collapse_slivers.h"
#include "frangia/fusion/internal/flip_caps.h"
#include "frangia/fusion/internal/sliver_candidates.h"
#include "frangia/geometry/selected_one_rings.h"

namespace frangia {

void remove_slivers(Mesh& mesh, std::span<const std::uint8_t> sharp, float lowest_mm) {
  const float shortest_mm = 2.0F * lowest_mm;
  SliverCandidates candidates(mesh, shortest_mm, lowest_mm);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const bool joined = collapse_slivers(mesh, sharp, shortest_mm, candidates);
    const bool turned = flip_caps(mesh, lowest_mm, candidates);
    if (!joined && !turned) break;
  }
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), is_removed),
                       mesh.triangles.end());
}

}  // namespace frangia
