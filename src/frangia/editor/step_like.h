#pragma once

#include <cstddef>

#include "frangia/core/enum_names.h"
#include "frangia/editor/edit_operation.h"

namespace frangia {

/// What a selection of triangles like a given one goes by.
enum class Likeness {
  Normal,     ///< the same direction, within 15 degrees
  Curvature,  ///< a mean curvature of at least nine tenths
  Sigma,      ///< a sigma of at least nine tenths; an unknown one: all that are unknown
  Mark        ///< the same mark
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(Likeness /*any*/) {
  return EnumNames<Likeness, 4>{{{Likeness::Normal, "normal"},
                                 {Likeness::Curvature, "curvature"},
                                 {Likeness::Sigma, "sigma"},
                                 {Likeness::Mark, "mark"}}};
}

/// The step that selects a triangle and all that are like it.
///
/// @errors   Error(Input) without such a triangle, for one without area, for its curvature at a
///           boundary and for its sigma where the mesh has none
[[nodiscard]] EditStep step_like(const Mesh& mesh, std::size_t triangle, Likeness likeness);

}  // namespace frangia
