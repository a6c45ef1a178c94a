#include "frangia/acceptance/frame_checksums.h"

#include <algorithm>
#include <vector>

#include "frangia/core/checksums.h"

namespace frangia {

FrameChecksums frame_checksums(const std::filesystem::path& scan, const Run& run) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (const char* file : {"rig.toml", "scan.toml"})
    if (fs::exists(scan / file)) files.push_back(scan / file);
  for (const auto& entry : fs::recursive_directory_iterator(scan / "views"))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  FrameChecksums checksums;
  checksums.files = files.size();
  for (const fs::path& file : files) {
    run.check();
    checksums.list += sha256_of_file(file) + "  " + file.lexically_normal().string() + "\n";
  }
  checksums.sha256 = sha256(checksums.list);
  return checksums;
}

}  // namespace frangia
