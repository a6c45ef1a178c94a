#include "frangia/surface/facets.h"

#include <cmath>
#include <cstddef>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

Facet facet_of(const Eigen::Vector3f& crossing_mm, const Evidence::Face& face) {
  const float per_weight = 1.0F / face.weight;
  Facet facet;
  facet.normal = face.normal.normalized();
  facet.point = crossing_mm - facet.normal * (face.offset * per_weight);
  facet.noise_mm = std::sqrt(face.noise_squared) * per_weight;
  facet.spacing_mm = face.spacing * per_weight;
  facet.views = face.views;
  facet.common = 0.0F;
  facet.holds = true;
  facet.has_side = false;
  return facet;
}

}  // namespace

Facet side_facet(const Crossings& crossings, const Evidences& evidence, std::size_t crossing) {
  return facet_of(crossings.points_mm[crossing], evidence.side(crossing));
}

Facets make_facets(const Crossings& crossings, const Evidences& evidence) {
  constexpr float kSpeaks = 0.1F;  // of the main face's weight
  Facets facets(evidence.size());
  parallel_chunks(evidence.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      facets[i].holds = evidence.holds(i);
      if (!facets[i].holds) continue;
      const Evidence::Face& main = evidence.main(i);
      const Evidence::Face& side = evidence.side(i);
      facets[i] = facet_of(crossings.points_mm[i], main);
      facets[i].common = evidence[i].common;
      facets[i].has_side = side.views != 0 && side.weight >= kSpeaks * main.weight;
    }
  });
  return facets;
}

}  // namespace frangia
