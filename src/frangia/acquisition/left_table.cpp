#include "frangia/acquisition/left_table.h"

#include <system_error>

#include "frangia/acquisition/internal/capture_manifest.h"

namespace frangia {

std::optional<LeftTable> left_table(const std::filesystem::path& scan_folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(scan_folder / "capture" / CaptureManifest::kFileName, ignored))
    return std::nullopt;
  const TableRecord record = CaptureManifest(scan_folder).table();
  if (record.intended_deg) return LeftTable{};
  if (!record.reached_deg) return std::nullopt;
  return LeftTable{record.reached_deg};
}

}  // namespace frangia
