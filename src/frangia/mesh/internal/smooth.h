#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/connectivity.h"
#include "frangia/mesh/smooth.h"

namespace frangia {

/// The vertices that smoothing may move, and their largest displacement.
class SmoothLimits {
 public:
  /// @errors   Error(Input) as smooth_taubin
  SmoothLimits(const Mesh& mesh, const HalfEdges& edges, const SmoothOptions& options);

  [[nodiscard]] bool may_move(std::size_t vertex) const { return movable_[vertex] != 0; }
  /// The permitted position nearest to `wanted`.
  [[nodiscard]] Eigen::Vector3f allowed(std::size_t vertex, const Eigen::Vector3f& wanted) const;
  [[nodiscard]] const std::vector<Eigen::Vector3f>& initial_mm() const { return initial_mm_; }

 private:
  std::vector<Eigen::Vector3f> initial_mm_;
  std::vector<std::uint8_t> movable_;
  std::vector<float> max_move_mm_;  ///< empty: no limit
};

}  // namespace frangia
