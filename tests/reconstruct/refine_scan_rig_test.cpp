#include "frangia/reconstruct/refine_scan_rig.h"

#include <cmath>
#include <filesystem>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/geometry/fit_primitives.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

/// RMS distance of the upper half of the ball at y < 0 from its own sphere.
double form_error_mm(const Mesh& mesh) {
  std::vector<Eigen::Vector3d> own;
  for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
    if (vertex.z() > 52.0F && vertex.y() < -5.0F) own.emplace_back(vertex.cast<double>());
  return fit_sphere(own).rms_mm;
}

TEST(RefineScanRig, RestoresTheShapeOfABallBarAfterTheProjectorMoved) {
  const testing::TemporaryFolder folder;
  Scan scan = testing::small_scan(folder.path() / "scan", "ball-bar", "digital", 6, {}, 4);
  ReconstructOptions options;
  const double exact_mm = form_error_mm(reconstruct(scan, options).mesh);
  Projector& projector = scan.rig.projector;
  const Eigen::Vector3d axis = Eigen::Vector3d(-0.5, 1.0, 0.4).normalized();
  projector.rotation =
      Eigen::AngleAxisd(rad_from_deg(0.1), axis).toRotationMatrix() * projector.rotation;
  projector.position_mm += Eigen::Vector3d(0.3, -0.2, 0.35);
  const double drifted_mm = form_error_mm(reconstruct(scan, options).mesh);
  options.refine_rig = true;
  const Reconstruction refined = reconstruct(scan, options);
  ASSERT_TRUE(refined.refinement);
  EXPECT_FALSE(refined.refinement->kept_rig) << refined.refinement->text();
  // Unasked, too: the views blame the rig.
  EXPECT_LT(drifted_mm, 1.3 * exact_mm);
  EXPECT_LT(form_error_mm(refined.mesh), 1.3 * exact_mm) << drifted_mm;
  // The covariance of the refined rig enters the systematic part.
  EXPECT_GT(refined.sigma.systematic_mm, 0.0);
}

}  // namespace
}  // namespace frangia
