#pragma once

#include "frangia/inspect/render_mesh.h"

namespace frangia::testing {

/// A picture that is drawn in no time.
inline RenderOptions small_picture(int width_px, int height_px) {
  RenderOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  options.samples_across = 2;
  return options;
}

}  // namespace frangia::testing
