#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "frangia/service/internal/surface_model.h"

namespace frangia {

/// The surface of a project as docs/service-api.md describes it. `summary` is the JSON of its
/// reconstruction, or empty.
[[nodiscard]] nlohmann::ordered_json json_of_surface(const SurfaceSnapshot& surface,
                                                     const std::string& summary);

}  // namespace frangia
