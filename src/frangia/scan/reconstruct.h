#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/range/drop_mixed_edges.h"
#include "frangia/scan/decode_view.h"
#include "frangia/scan/scan_folder.h"
#include "frangia/surface/mesh.h"
#include "frangia/surface/paste_views.h"
#include "frangia/views/anchor_by_views.h"
#include "frangia/views/reconcile_views.h"

namespace frangia {

struct ReconstructOptions {
  DecodeOptions decode;
  EdgeOptions edges;
  AnchorByViewsOptions anchor_by_views;
  ReconcileOptions reconcile;
  PasteOptions paste;
};

struct Reconstruction {
  Mesh mesh;
  std::size_t points = 0;  ///< measured, in all views
  std::size_t views = 0;   ///< that held any
};

/// The whole path of light: frames, phase, range, views, surface.
///
/// units    mm, object frame
/// missing  a view without a lit pixel is left out with a warning
/// errors   Error(Input) when no view has a lit pixel, and all that the stages throw
[[nodiscard]] Reconstruction reconstruct(const Scan& scan,
                                         const ReconstructOptions& options = {},
                                         const Run& run = {});

}  // namespace frangia
