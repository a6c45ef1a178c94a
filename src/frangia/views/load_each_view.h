#pragma once

#include <cstddef>
#include <functional>

#include "frangia/views/view_store.h"

namespace frangia {

/// Calls `use` with the number and the points of each view in turn, as `ViewStore::load_points`
/// returns them. The next view is loaded meanwhile, so memory holds two views.
///
/// @errors   Error(File) when a view cannot be read; and what `use` throws
void load_each_view(const ViewStore& views,
                    const std::function<void(std::size_t index, View& view)>& use,
                    PointSigma sigma = PointSigma::Noise);

}  // namespace frangia
