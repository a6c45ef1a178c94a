#include "frangia/dataset/capture_times.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "frangia/core/missing.h"
#include "frangia/dataset/read_frames.h"

namespace frangia {

std::vector<double> read_capture_times(const Scan& scan) {
  struct Mean {
    double sum_s = 0.0;
    double count = 0.0;
  };
  std::map<std::filesystem::path, Mean> folders;
  for (const auto& [file, frame] : read_stored_frames(scan.folder)) {
    if (std::isnan(frame.at_s)) continue;
    Mean& mean = folders[std::filesystem::path(file).parent_path()];
    mean.sum_s += frame.at_s;
    mean.count += 1.0;
  }
  std::vector<double> times_s;
  for (const ScanView& view : scan.views) {
    const auto found = folders.find(view.folder);
    times_s.push_back(found == folders.end() ? kMissing
                                             : found->second.sum_s / found->second.count);
  }
  return times_s;
}

double read_capture_begin(const Scan& scan) {
  return read_began_s(scan.folder);
}

}  // namespace frangia
