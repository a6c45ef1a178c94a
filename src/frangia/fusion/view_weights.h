#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// How much each view counted at the places where a surface was fused.
class ViewWeights {
 public:
  /// The number of a view and its weight, 1/mm^2.
  using View = std::pair<std::uint16_t, float>;
  /// A place of the surface, which several views measured.
  struct Place {
    Eigen::Vector3f point_mm;  ///< object frame
    Eigen::Vector3f normal;    ///< unit
    std::uint32_t first = 0;   ///< of its views, which end where those of the next place begin
  };

  /// No surface.
  ViewWeights() = default;
  /// Keeps places, which are about `spacing_mm` apart, and their views one after another.
  ViewWeights(double spacing_mm, std::span<const Place> places, std::vector<View> views);

  /// Whether there is no place.
  [[nodiscard]] bool empty() const { return places_.empty(); }

  /// Shares of the views at a point of the surface: those of the places around it that face the
  /// same way, the nearer the more.
  ///
  /// @shape    `shares` has a number for each view and is set; they sum up to 1, or to 0 where no
  ///           place is within 1.5 spacings
  void shares_at(const Eigen::Vector3f& point_mm,
                 const Eigen::Vector3f& normal,
                 Eigen::Ref<Eigen::VectorXf> shares) const;

 private:
  [[nodiscard]] Eigen::Vector3i cell_of(const Eigen::Vector3f& point_mm) const;

  float spacing_mm_ = 1.0F;
  /// Cells of the grid that hold places, ascending, with their first place.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> cells_;
  std::vector<Place> places_;        ///< in the order of the cells
  std::vector<std::uint32_t> ends_;  ///< of the views of each place
  std::vector<View> views_;
};

}  // namespace frangia
