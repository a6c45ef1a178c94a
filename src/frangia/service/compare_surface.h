#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspect/deviation_summary.h"
#include "frangia/inspect/surface_verdict.h"

namespace frangia {

/// How a surface is compared with a reference.
struct CompareOptions {
  bool best_fit = true;  ///< moves the surface onto the reference first; otherwise as it stands
  ToleranceLimits tolerance{-0.1, 0.1};  ///< of the deviations, mm
  std::size_t start = 0;  ///< index among `SurfaceComparison::poses` of the best fit to take
};

/// A pose in which a surface fits its reference.
struct ComparedPose {
  double turned_rad = 0.0;  ///< by the alignment
  double moved_mm = 0.0;    ///< by the alignment
  double overlap = 0.0;     ///< share of the surface that lies on the reference
  double rms_mm = 0.0;      ///< of that share
};

/// Deviations of a surface from a reference and what they amount to.
struct SurfaceComparison {
  std::vector<float> deviation_mm;  ///< of each vertex, positive outside; NaN: not compared
  DeviationSummary summary;         ///< unfiltered
  SurfaceVerdict verdict;           ///< by the patches of the reference
  std::vector<float> histogram;     ///< shares of the area, from `low_mm` to `high_mm`
  double low_mm = 0.0;              ///< of the color scale: twice the tolerance
  double high_mm = 0.0;             ///< likewise
  double overlap = 0.0;             ///< share of the surface that lies on the reference
  double fit_rms_mm = 0.0;          ///< of that share
  double turned_rad = 0.0;          ///< by the alignment
  double moved_mm = 0.0;            ///< by the alignment
  std::size_t left_out = 0;         ///< vertices that were not compared
  std::vector<std::string> free_directions;  ///< motions that the shape does not determine
  std::size_t triangles = 0;                 ///< of the reference
  /// Poses that fit alike, the best first; one for a unique pose, none as the surface stands.
  std::vector<ComparedPose> poses;
};

/// Extensions of the files that may be references, without their dot.
[[nodiscard]] const std::vector<std::string>& reference_formats();

/// Compares a surface with a mesh or CAD file, as `frangia inspect --align` does.
///
/// @units    mm; a file without a unit is taken to be in mm
/// @errors   Error(Input) when the file has no triangles, and those of read_mesh, read_cad,
///           align_best_fit and deviations_of
[[nodiscard]] SurfaceComparison compare_surface(const Mesh& mesh,
                                                const std::filesystem::path& reference,
                                                const CompareOptions& options = {},
                                                const Run& run = {});

}  // namespace frangia
