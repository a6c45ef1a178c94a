#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/service/internal/command_arguments.h"
#include "frangia/service/project_folder.h"

namespace frangia {

/// A surface that was built, with its edits.
struct SurfaceVersion {
  int number = 0;            ///< from 1
  int previous = 0;          ///< shown when this one was built; 0: none
  std::int64_t built_s = 0;  ///< seconds since 1970
  /// Its files are beside the folder of the versions, as programs before there were versions wrote
  /// them.
  bool in_place = false;
  int edits = 0;          ///< revision whose file of edits holds; 0: none, or the one in place
  std::size_t steps = 0;  ///< of its edits, undone ones included
  std::size_t done = 0;   ///< of them
};

/// A command that was carried out.
struct AnsweredCommand {
  CommandKey key;
  int revision = 0;  ///< that it made
};

/// The surfaces of a project and which of them is shown, as versions.json states them. A revision
/// is a state of all this: each change makes the next one.
struct SurfaceVersions {
  int revision = 0;                       ///< 0: nothing was ever changed
  int current = 0;                        ///< number of the version that is shown; 0: none
  std::vector<SurfaceVersion> all;        ///< by number
  std::vector<AnsweredCommand> answered;  ///< the last kMostAnswered, the newest last

  static constexpr std::size_t kMostAnswered = 64;
  static constexpr int kMostRevisions = 2'000'000'000;
  static constexpr int kMostVersions = 100'000;

  /// The version of a number; null without it.
  [[nodiscard]] const SurfaceVersion* find(int number) const;
  [[nodiscard]] SurfaceVersion* find(int number);
  /// The command of a key; null when it is not among the last ones.
  [[nodiscard]] const AnsweredCommand* find(const CommandKey& key) const;
  /// Enters that a command, which may have no id, made the present revision.
  void answer(const CommandKey& key);
};

/// Where the files of a version are. Its functions throw Error(Input) as `path_below` for a link.
struct VersionFiles {
  std::filesystem::path folder;
  std::filesystem::path edits;  ///< script, see read_edit_script; there need not be one

  [[nodiscard]] std::filesystem::path surface() const { return path_below(folder, "surface.ply"); }
  /// Figures of the reconstruction, JSON.
  [[nodiscard]] std::filesystem::path summary() const { return path_below(folder, "surface.json"); }
  /// Registered points of a joined setup, counted from 0, packed by encode_points.
  [[nodiscard]] std::filesystem::path setup_cloud(std::size_t joined) const;
};

[[nodiscard]] VersionFiles files_of(const ProjectFolder& project, const SurfaceVersion& version);

/// Where the edits of a version are written that belong to a revision.
[[nodiscard]] std::filesystem::path edits_file(const ProjectFolder& project,
                                               const SurfaceVersion& version,
                                               int revision);

/// Folder in which a version is made.
[[nodiscard]] std::filesystem::path new_version_folder(const ProjectFolder& project);

/// A number that no version has and no folder in that of the versions.
[[nodiscard]] int next_version_number(const ProjectFolder& project,
                                      const SurfaceVersions& versions);

/// Reads which surfaces a project has. Without versions.json, a surface.ply in place is the first.
///
/// @errors   Error(Input) that names versions.json when it is damaged
[[nodiscard]] SurfaceVersions read_surface_versions(const ProjectFolder& project);

/// The state on the disk is unknown: it could not be read after a write had failed.
class SurfaceUnknown : public Error {
 public:
  using Error::Error;
};

/// The commit point of every change of a project's surfaces: versions.json is renamed into its
/// place and the folder synced. All other files that `versions` names are on the disk before.
///
/// Returns an empty sentence, or, when the rename took place and the disk did not confirm it, what
/// to say about that: the state that is read then is `versions`.
/// @errors   Error(File) when it cannot be written: nothing has changed; SurfaceUnknown
[[nodiscard]] std::string commit_surface_versions(const ProjectFolder& project,
                                                  const SurfaceVersions& versions);

/// Removes what interrupted changes left: a version that was being made, edits of other revisions
/// and temporary files. Removes nothing unless the disk confirms the present versions.json.
void remove_leftovers(const ProjectFolder& project, const SurfaceVersions& versions) noexcept;

}  // namespace frangia
