#pragma once

#include "frangia/core/missing.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Medians of the uncertainties of a mesh's vertices.
///
/// @units    mm
/// @missing  NaN without a known value; the parts are NaN when no systematic part is known
struct MedianSigma {
  double combined_mm = kMissing;    ///< median of `Mesh::sigma_mm`
  double noise_mm = kMissing;       ///< median of `Mesh::sigma_noise_mm`
  double systematic_mm = kMissing;  ///< median of `Mesh::sigma_systematic_mm`
};

/// Computes the medians of the known values. The medians of the parts do not combine to that of
/// their combination.
[[nodiscard]] MedianSigma median_sigma(const Mesh& mesh);

}  // namespace frangia
