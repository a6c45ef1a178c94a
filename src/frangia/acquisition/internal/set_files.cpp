#include "frangia/acquisition/internal/set_files.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "frangia/core/make_folder.h"
#include "frangia/core/open_below.h"
#include "frangia/core/sync_to_disk.h"

namespace frangia {

std::string SetFiles::set_of(std::size_t view, const Pattern& pattern) const {
  return (plan_.views[view].folder / pattern.name).generic_string();
}

std::filesystem::path SetFiles::folder_of(std::size_t view, std::size_t camera) const {
  const std::filesystem::path& folder = plan_.views[view].folder;
  return camera == 0 ? folder : folder / plan_.rig.cameras[camera].camera.name;
}

std::size_t SetFiles::cameras() const {
  return plan_.rig.cameras.size();
}

std::string SetFiles::file_of(
    std::size_t view, const Pattern& pattern, int frame, int exposure, std::size_t camera) const {
  return (folder_of(view, camera) / frame_file_name(pattern, frame, exposure)).generic_string();
}

std::size_t SetFiles::frames_per_view() const {
  int count = 0;
  for (const Pattern& pattern : plan_.patterns)
    count += pattern.frame_count() * pattern.exposure_count();
  return static_cast<std::size_t>(count);
}

bool SetFiles::has_all_frames(std::size_t view, const Pattern& pattern) const {
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      for (std::size_t camera = 0; camera < cameras(); ++camera)
        if (!manifest_.has(file_of(view, pattern, frame, exposure, camera))) return false;
    }
  }
  return true;
}

bool SetFiles::is_complete(std::size_t view) const {
  return std::all_of(plan_.patterns.begin(), plan_.patterns.end(), [&](const Pattern& pattern) {
    return has_all_frames(view, pattern) && manifest_.is_good(set_of(view, pattern));
  });
}

bool SetFiles::is_begun(std::size_t view) const {
  return std::any_of(plan_.patterns.begin(), plan_.patterns.end(), [&](const Pattern& pattern) {
    const std::vector<bool> stored = stored_frames(view, pattern);
    return manifest_.attempt_of(set_of(view, pattern)) > 0 ||
           std::find(stored.begin(), stored.end(), true) != stored.end();
  });
}

double SetFiles::scale_of(std::size_t view, const Pattern& pattern) const {
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
      const ManifestFrame* stored = manifest_.find(file_of(view, pattern, frame, exposure));
      if (stored != nullptr) return stored->scale;
    }
  }
  return manifest_.scale();
}

std::vector<bool> SetFiles::stored_frames(std::size_t view, const Pattern& pattern) const {
  std::vector<bool> stored;
  for (int frame = 0; frame < pattern.frame_count(); ++frame) {
    for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure)
      stored.push_back(manifest_.has(file_of(view, pattern, frame, exposure)));
  }
  return stored;
}

void SetFiles::move_to_rejected(std::size_t view, const Pattern& pattern, int attempt) const {
  for (std::size_t camera = 0; camera < cameras(); ++camera) {
    const std::filesystem::path folder = path_below(plan_.folder, folder_of(view, camera));
    const std::filesystem::path rejected = path_below(folder, "rejected");
    make_folder(rejected, Durability::Synced);
    for (int frame = 0; frame < pattern.frame_count(); ++frame) {
      for (int exposure = 0; exposure < pattern.exposure_count(); ++exposure) {
        const std::string name = frame_file_name(pattern, frame, exposure);
        const std::filesystem::path to = rejected / fmt::format("{}-{}", attempt, name);
        const bool counts = manifest_.has(file_of(view, pattern, frame, exposure, camera));
        if (!counts && std::filesystem::exists(folder / name) && !std::filesystem::exists(to))
          std::filesystem::rename(folder / name, to);
      }
    }
    sync_to_disk(rejected);
    sync_to_disk(folder);
  }
}

}  // namespace frangia
