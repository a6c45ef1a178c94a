#include "frangia/surface/smooth_out.h"

#include <algorithm>

#include "frangia/surface/collapse_slivers.h"
#include "frangia/surface/flip_caps.h"
#include "frangia/surface/rough_triangles.h"
#include "frangia/surface/stars.h"

namespace frangia {

void smooth_out(Mesh& mesh, std::span<const std::uint8_t> sharp, float lowest_mm) {
  const float shortest_mm = 2.0F * lowest_mm;
  RoughTriangles rough(mesh, shortest_mm, lowest_mm);
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const bool joined = collapse_slivers(mesh, sharp, shortest_mm, rough);
    const bool turned = flip_caps(mesh, lowest_mm, rough);
    if (!joined && !turned) break;
  }
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), is_gone),
                       mesh.triangles.end());
}

}  // namespace frangia
