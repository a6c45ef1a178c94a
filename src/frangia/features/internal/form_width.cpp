#include "frangia/features/internal/form_width.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace frangia {

FormWidth form_width(std::vector<SurfaceValue> values, const WantedZone& zone) {
  const FilteredRange range = filtered_range(std::move(values));
  if (zone.shape == nullptr) return {range.high - range.low, range.u95};
  std::vector<Eigen::Vector3d> points;
  points.reserve(range.values.size());
  for (const SurfaceValue& one : range.values) {
    const ShapeDistance at = distance_to(*zone.shape, one.point_mm);
    points.emplace_back(one.point_mm + (one.value - at.distance_mm) * at.normal);
  }
  return {minimum_zone_width(*zone.shape, points, zone.freedom), range.u95};
}

FormWidth largest_section_width(const std::vector<SurfaceValue>& values,
                                const Eigen::Vector3d& center_mm,
                                const Eigen::Vector3d& axis,
                                const WantedZone& zone) {
  constexpr std::size_t kSections = 24;
  constexpr std::size_t kLeast = 96;
  double low = 0.0;
  double high = 0.0;
  for (const SurfaceValue& one : values) {
    const double along = (one.point_mm - center_mm).dot(axis);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  const std::size_t count =
      std::clamp<std::size_t>(values.size() / (4 * kLeast), std::size_t{1}, kSections);
  std::vector<std::vector<SurfaceValue>> sections(count);
  for (const SurfaceValue& one : values) {
    const double share = ((one.point_mm - center_mm).dot(axis) - low) / std::max(high - low, 1e-12);
    const double at = share * static_cast<double>(count);
    sections[std::min(static_cast<std::size_t>(at), count - 1)].push_back(one);
  }
  FormWidth largest;
  for (auto& section : sections) {
    if (section.size() < kLeast && count > 1) continue;
    if (section.empty()) continue;
    const FormWidth width = form_width(std::move(section), zone);
    if (width.value >= largest.value) largest = width;
  }
  return largest;
}

}  // namespace frangia
