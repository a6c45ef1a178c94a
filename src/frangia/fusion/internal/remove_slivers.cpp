#include "frangia/fusion/internal/remove_slivers.h"

#include <algorithm>

#include "frangia/fusion/internal/collapse_slivers.h"
#include "frangia/fusion/internal/flip_caps.h"
#include "frangia/fusion/internal/sliver_candidates.h"
#include "frangia/geometry/one_rings.h"

namespace frangia {

void remove_slivers(Mesh& mesh,
                    std::span<const std::uint8_t> sharp,
                    float lowest_mm,
                    const CleanupParameters& parameters) {
  const float shortest_mm = 2.0F * lowest_mm;
  SliverCandidates candidates(mesh, shortest_mm, lowest_mm);
  constexpr int kMostPasses = 3;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const bool collapsed = collapse_slivers(mesh, sharp, shortest_mm, candidates, parameters);
    const bool flipped = flip_caps(mesh, lowest_mm, candidates);
    if (!collapsed && !flipped) break;
  }
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), is_removed),
                       mesh.triangles.end());
}

}  // namespace frangia
