#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace frangia {

/// The wrapped phases that several maps can have together: a curve over the projector's field.
///
/// A place `u` of the field has the phases 2 pi f u of all maps, modulo 2 pi. Phases that do not
/// lie near this curve belong to other frequencies, starts or directions than those of the curve.
class FringeCurve {
 public:
  /// `per_unit` holds the fringes per projector pixel or degree of each map; the field is from
  /// `first` to `last`, in these units.
  FringeCurve(std::vector<double> per_unit, double first, double last);

  /// The point of the curve that is nearest to the phases of a pixel.
  struct Nearest {
    float distance_rad = 0.0F;  ///< root of the squared distances in all maps
    float unit = 0.0F;          ///< place of the point in the field
  };
  /// `phases_rad` holds one phase per map. Points outside of the field are allowed at the cost of
  /// their distance from it.
  [[nodiscard]] Nearest nearest(std::span<const float> phases_rad);

 private:
  std::vector<double> per_unit_;
  double first_;
  double last_;
  std::size_t finest_ = 0;  ///< index of the map with the most fringes
  double slope_weight_ = 0.0;
  std::vector<float> absolute_;  ///< phase of the finest map in each order
  std::vector<float> square_;
  std::vector<float> along_;
};

}  // namespace frangia
