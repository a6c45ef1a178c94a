#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace frangia {

/// A file of the front end, compiled into the program.
struct WebAsset {
  std::string_view path;  ///< "/assets/index-1a2b3c4d.js"
  std::string_view type;  ///< Content-Type
  std::string_view gzip;  ///< its bytes, compressed
};

/// All files of the front end. The build generates the source from web/.
[[nodiscard]] std::span<const WebAsset> web_assets();

}  // namespace frangia
