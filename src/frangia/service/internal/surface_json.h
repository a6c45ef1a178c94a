#pragma once

#include <nlohmann/json.hpp>

#include "frangia/service/internal/surface_model.h"

namespace frangia {

/// The surface of a project as docs/service-api.md describes it.
[[nodiscard]] nlohmann::ordered_json json_of_surface(const SurfaceSnapshot& surface);

}  // namespace frangia
