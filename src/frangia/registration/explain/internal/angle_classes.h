#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/explain/pose_explanation.h"
#include "frangia/registration/internal/table_state.h"

namespace frangia {

/// How angles differ from those given.
enum class AngleClass : std::uint8_t {
  Scaled,     ///< in proportion
  Step,       ///< by the same from one view on
  Exchanged,  ///< two views have each other's angle
  Alone,      ///< of one view
  Even,       ///< the views are evenly spaced, where one angle is given for all
  All         ///< of any views
};

/// Angles of all views, and how they differ from those given.
struct ClassedAngles {
  std::vector<double> angles_rad;
  AngleClass kind = AngleClass::All;
  PoseExplanation as{};
  double fit = 0.0;  ///< of the views
};

[[nodiscard]] ClassedAngles angles_scaled_by(const std::vector<double>& given_rad, double factor);
[[nodiscard]] ClassedAngles turned_from(const std::vector<double>& given_rad,
                                        std::size_t first,
                                        double by_rad);
[[nodiscard]] ClassedAngles turned_alone(const std::vector<double>& given_rad,
                                         std::size_t view,
                                         double by_rad);
[[nodiscard]] ClassedAngles exchanged_angles(const std::vector<double>& given_rad,
                                             std::size_t one,
                                             std::size_t other);
[[nodiscard]] ClassedAngles evenly_spaced(const std::vector<double>& given_rad, double step_rad);
/// The angles of all views, turned together so that most views have that which is given.
[[nodiscard]] ClassedAngles all_turned(const std::vector<double>& given_rad,
                                       std::vector<double> angles_rad);

/// The simplest angles that turns of the views follow, against those given.
[[nodiscard]] ClassedAngles simplest_of(const std::vector<double>& given_rad,
                                        const std::vector<double>& turned_rad);

/// The angles of the class that are nearest to refined ones.
[[nodiscard]] ClassedAngles followed(const std::vector<double>& given_rad,
                                     const ClassedAngles& found,
                                     const std::vector<double>& refined_rad);

/// Turns of the views about the table's axis from where the given angles place them to other poses,
/// from that of the first.
[[nodiscard]] std::vector<double> turned_to(const TableState& given,
                                            const std::vector<Eigen::Isometry3d>& object_from_rig);

/// How much farther a view turned than the first one.
struct ViewChange {
  std::size_t view = 0;
  double change_rad = 0.0;  ///< at least 0
};

/// Of the view whose turn differs most from that of the first.
[[nodiscard]] ViewChange largest_change(const std::vector<double>& given_rad,
                                        const std::vector<double>& angles_rad);

}  // namespace frangia
