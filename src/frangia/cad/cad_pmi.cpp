#include "frangia/cad/cad_pmi.h"

#include <array>

namespace frangia {

std::string_view name_of(CadRequirementKind kind) {
  constexpr std::array<std::string_view, kCadRequirementKinds> kNames{"datum",
                                                                      "diameter",
                                                                      "distance",
                                                                      "angle",
                                                                      "flatness",
                                                                      "roundness",
                                                                      "cylindricity",
                                                                      "parallelism",
                                                                      "perpendicularity",
                                                                      "position",
                                                                      "run-out",
                                                                      "total-run-out",
                                                                      "surface profile",
                                                                      "other"};
  return kNames.at(static_cast<std::size_t>(kind));
}

}  // namespace frangia
