#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/rig/rig.h"
#include "frangia/scan_plan/scan_recipe.h"

namespace frangia {

/// What a virtual scan assumes of part and camera.
struct VirtualScanOptions {
  double reflectance = 1.0;  ///< of the part, relative to the white that the exposure is right for
  double gloss = 0.0;        ///< strength of the highlight, relative to the diffuse white
  double ambient = 0.0;      ///< light of the room on white, as a share of the camera's white level
  /// Camera noise of a rig that states none, as of a camera with 8 bits.
  double full_well_e = 20000.0;
  double read_e = 8.0;  ///< see `full_well_e`
  /// The camera has this many times fewer pixels on a side. A vertex has the same number of
  /// pixels, but a pixel more of what curves, so that U95 is too large, up to four times.
  int divisor = 1;
  std::uint64_t seed = 1;  ///< of the noise

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// A part that was scanned in software.
struct VirtualScan {
  Mesh mesh;  ///< in the frame of setup 0 on the turntable, with sigma
  Eigen::Isometry3d table_from_part = Eigen::Isometry3d::Identity();  ///< of setup 0
  /// Poses of the object in all views, in the frame of the part.
  std::vector<Eigen::Isometry3d> rig_from_part;
  Rig rig;  ///< with the pixels of the divisor
};

/// A rig whose cameras have fewer pixels for the same field, with the covariance of its parameters.
[[nodiscard]] Rig coarser_rig(Rig rig, int divisor);

/// Scans a part in software as a recipe says, and reconstructs it: the frames have the noise of the
/// camera, the reconstruction states sigma with all its terms, the covariance of the rig among
/// them. The poses of the setups are known.
///
/// @units    mm
/// @errors   Error(Input) as simulate_scan and reconstruct; Error(Numeric) where no view sees the
///           part; Error(File) when the temporary folder cannot hold the frames; Error(Cancelled)
/// @source   virtual measurement: ISO/TS 15530-4
[[nodiscard]] VirtualScan virtual_scan(const Mesh& part,
                                       const Rig& rig,
                                       const ScanRecipe& recipe,
                                       const VirtualScanOptions& options = {},
                                       const Run& run = {});

}  // namespace frangia
