#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/surface_patches.h"

namespace frangia::inspect {

/// Patches of which the material is missing: 1, otherwise 0.
///
/// Nothing was measured in such a patch or, by two diameters, near it; but surface was measured
/// behind it, inside of the nominal material, that faces the same way: the light of a view reached
/// it through the place of the patch. All patches around agree, and the part of the surface that
/// does is as wide as its material is deep, so that a view in any direction which reaches that
/// surface has passed it.
///
/// Or surface was measured inside of the nominal material, farther than a diameter from all of its
/// surface, as at the root of a pin, and whatever view reached it has passed patches where nothing
/// was measured: those, unless measured surface is near.
///
/// Without the views, nothing else proves that material is missing; a patch with nothing behind it
/// is not measured.
///
/// @shape    `mesh` is the measured one, of `deviations`; one value for each patch
[[nodiscard]] std::vector<std::uint8_t> missing_patches(const SurfacePatches& patches,
                                                        const Mesh& mesh,
                                                        const Deviations& deviations,
                                                        const RayScene& reference,
                                                        const Run& run);

}  // namespace frangia::inspect
