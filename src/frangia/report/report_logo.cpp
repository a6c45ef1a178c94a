#include "frangia/report/report_logo.h"

#include <string_view>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/read_regular_file.h"
#include "frangia/frames/image_file.h"

namespace frangia {

ReportLogo read_logo(const std::filesystem::path& path) {
  constexpr std::size_t kMost = 2U << 20U;
  const auto content = read_regular_file(path, kMost);
  const std::string_view begin(content.data(), content.size());
  ReportLogo logo;
  if (begin.starts_with("\x89PNG\r\n\x1A\n")) logo.media_type = "image/png";
  if (begin.starts_with("\xFF\xD8\xFF")) logo.media_type = "image/jpeg";
  if (logo.media_type.empty()) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{}: the logo of a report must be a PNG or JPEG picture", path.string()));
  }
  // A picture that is cut short would leave a hole in a report that is signed.
  static_cast<void>(ImageFile(path).read());
  logo.bytes.assign(content.begin(), content.end());
  return logo;
}

}  // namespace frangia
