#pragma once

#include "frangia/inspect/render_mesh.h"

namespace frangia::testing {

/// A picture that renders fast, without a legend.
inline RenderOptions small_picture(int width_px, int height_px) {
  RenderOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  options.samples_across = 2;
  options.legend = false;
  return options;
}

}  // namespace frangia::testing
