#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"
#include "frangia/inspect/internal/patch_grid.h"

namespace frangia::inspect {

/// Cosine between two normals above which surfaces look to the same side, as the limit of
/// `DeviationStatus::OtherSide`.
inline constexpr float kSameSide = -0.2F;

/// The strips along the edges of a nominal surface.
///
/// An edge is where the surface turns by more than 30 degrees between two triangles, or by more
/// than 60 within the width of a strip: a radius below the width. The shape of an edge that a
/// drawing does not state is not defined (ISO 13715), and a measurement rounds it by the distance
/// of its points.
class EdgeStrips {
 public:
  /// Finds the edges. None with a width of 0.
  ///
  /// @units    mm
  EdgeStrips(const Mesh& nominal, double width_mm);

  /// Whether a point of the nominal surface, with its normal, lies in a strip.
  [[nodiscard]] bool hold(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;

 private:
  struct Bend {
    Eigen::Vector3f one;    ///< normal on one side, unit
    Eigen::Vector3f other;  ///< on the other side
    bool sharp = false;
  };

  double width_mm_;
  PatchGrid grid_;
  std::vector<Bend> bends_;  ///< of each point of the grid
};

}  // namespace frangia::inspect
