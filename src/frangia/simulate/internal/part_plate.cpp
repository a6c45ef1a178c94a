#include "frangia/simulate/internal/solid_builder.h"
#include "frangia/simulate/parts.h"

namespace frangia {

Mesh make_plate() {
  const auto outline = [](double x) {
    return Loop{{x, -40.0, 0.0}, {x, 40.0, 0.0}, {x, 40.0, 60.0}, {x, -40.0, 60.0}};
  };
  const Loop front = outline(3.0);
  const Loop back = outline(-3.0);
  SolidBuilder solid;
  solid.add_face(front);
  solid.add_band(back, front);
  solid.add_face({back.rbegin(), back.rend()});
  return solid.build();
}

}  // namespace frangia
