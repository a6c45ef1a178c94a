#include "frangia/simulate/internal/sheet.h"

#include "frangia/simulate/internal/solid_builder.h"

namespace frangia {

Mesh make_sheet(const Eigen::Vector2d& half) {
  constexpr double kThickness_mm = 3.0;
  const auto outline = [&](double z) {
    return Loop{{-half.x(), -half.y(), z},
                {half.x(), -half.y(), z},
                {half.x(), half.y(), z},
                {-half.x(), half.y(), z}};
  };
  const Loop face = outline(0.0);
  const Loop back = outline(kThickness_mm);
  SolidBuilder solid;
  solid.add_face(back);
  solid.add_band(face, back);
  solid.add_face({face.rbegin(), face.rend()});
  return solid.build();
}

}  // namespace frangia
