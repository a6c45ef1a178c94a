#pragma once

#include <vector>

#include "frangia/core/image.h"
#include "frangia/views/view.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Whether no two views look from nearly the same direction, within 5 degrees. Where they do, the
/// fringes lie alike on the surface, and so do the errors that otherwise differ from view to view.
[[nodiscard]] bool have_directions_of_their_own(const std::vector<const ViewStore*>& stores);

/// The part of a view's systematic uncertainty that differs from view to view, mm along the rays;
/// empty without one.
[[nodiscard]] Image<float> differing_part(const View& view);

}  // namespace frangia
