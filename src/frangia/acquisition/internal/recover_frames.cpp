#include "frangia/acquisition/internal/recover_frames.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/core/read_regular_file.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

/// The bytes of a frame; empty when the file is missing, damaged or of another size.
std::optional<std::vector<char>> intact_frame(const std::filesystem::path& folder,
                                              const std::string& file,
                                              const CameraModel& camera) {
  try {
    const std::filesystem::path path = path_below(folder, file);
    std::vector<char> bytes = read_regular_file(path);
    static_cast<void>(read_png(path, [&](int width_px, int height_px) {
      require(width_px == camera.width_px && height_px == camera.height_px, "another size");
    }));
    return bytes;
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Whether the file at the frame's path was captured after the set's last rejection: `SetFiles`
/// then moved the rejected frame away first.
bool is_of_last_attempt(const std::filesystem::path& folder,
                        const std::string& frame_name,
                        int attempt) {
  return attempt == 0 || std::filesystem::exists(folder / "rejected" /
                                                 fmt::format("{}-{}", attempt - 1, frame_name));
}

/// The frames of one camera and set.
std::size_t recover_set(const Scan& plan,
                        const SetFiles& files,
                        std::size_t view,
                        const Pattern& pattern,
                        std::size_t camera,
                        CaptureManifest& manifest) {
  const CameraModel& model = plan.rig.cameras[camera].camera.model;
  const int attempt = manifest.attempt_of(files.set_of(view, pattern));
  std::size_t count = 0;
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      const std::string file = files.file_of(view, pattern, frame, exposure, camera);
      if (manifest.has(file) || !is_of_last_attempt(plan.folder / files.folder_of(view, camera),
                                                    frame_file_name(pattern, frame, exposure),
                                                    attempt))
        continue;
      const auto bytes = intact_frame(plan.folder, file, model);
      if (!bytes) continue;
      manifest.add_recovered(file, *bytes);
      ++count;
    }
  }
  return count;
}

}  // namespace

std::size_t recover_frames(const Scan& plan, const SetFiles& files, CaptureManifest& manifest) {
  std::size_t count = 0;
  for (std::size_t view = 0; view < plan.views.size(); ++view) {
    for (const Pattern& pattern : plan.patterns) {
      const std::string set = files.set_of(view, pattern);
      if (!manifest.may_lack_frames_of(set)) continue;
      for (std::size_t camera = 0; camera < files.cameras(); ++camera)
        count += recover_set(plan, files, view, pattern, camera, manifest);
    }
  }
  return count;
}

}  // namespace frangia
