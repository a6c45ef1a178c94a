#include "frangia/simulate/internal/solid_builder.h"
#include "frangia/simulate/parts.h"

namespace frangia {

Mesh make_groove() {
  constexpr double kHeight = 50.0;
  const auto outline = [](double z) {
    return Loop{{-20.0, -32.0, z},
                {15.0, -32.0, z},
                {15.0, -25.0, z},
                {-10.0, 0.0, z},
                {15.0, 25.0, z},
                {15.0, 32.0, z},
                {-20.0, 32.0, z}};
  };
  const Loop low = outline(0.0);
  const Loop high = outline(kHeight);
  SolidBuilder solid;
  solid.add_face(high);
  solid.add_band(low, high);
  solid.add_face(reversed(low));
  return solid.build();
}

}  // namespace frangia
