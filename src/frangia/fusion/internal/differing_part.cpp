#include "frangia/fusion/internal/differing_part.h"

#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"

namespace frangia {

bool have_directions_of_their_own(const std::vector<const ViewStore*>& stores) {
  constexpr double kApart = rad_from_deg(5.0);
  std::vector<Eigen::Matrix3d> rotations;
  for (const ViewStore* store : stores) {
    for (std::size_t i = 0; i < store->size(); ++i)
      rotations.emplace_back(store->rig_from_object(i).linear());
  }
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (Eigen::AngleAxisd(rotations[i].transpose() * rotations[k]).angle() < kApart) return false;
    }
  }
  return true;
}

Image<float> differing_part(const View& view) {
  const auto& range = view.range;
  if (range.systematic_mm.empty() || range.differing_share == 0.0F) return {};
  Image<float> out = range.systematic_mm;
  const float factor = std::sqrt(range.differing_share);
  for (float& part : out.pixels())
    part *= factor;
  return out;
}

}  // namespace frangia
