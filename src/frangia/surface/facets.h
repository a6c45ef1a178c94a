#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "frangia/core/pieces.h"
#include "frangia/surface/crossings.h"
#include "frangia/surface/evidence.h"

namespace frangia {

/// The surface at one crossing, as most of the views that saw it say: what the four cells around it
/// take.
///
/// units    mm, object frame
struct Facet {
  Eigen::Vector3f point;   ///< of the surface, nearest to the crossing
  Eigen::Vector3f normal;  ///< unit
  float noise_mm;          ///< what the views' noise leaves of itself
  float spacing_mm;        ///< of pixels
  float common;            ///< variance that does not average away between neighbours
  std::uint16_t views;
  bool holds;     ///< see `Evidences::holds`; the rest says nothing where it does not
  bool has_side;  ///< another face runs near, and more than chance speaks for it
};

using Facets = Pieces<Facet>;

/// One facet a crossing.
[[nodiscard]] Facets make_facets(const Crossings& crossings, const Evidences& evidence);

/// The plane of the other face near a crossing.
[[nodiscard]] Facet side_facet(const Crossings& crossings,
                               const Evidences& evidence,
                               std::size_t crossing);

}  // namespace frangia
