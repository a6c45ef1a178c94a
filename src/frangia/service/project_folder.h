#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/file_descriptor.h"
#include "frangia/core/open_below.h"
#include "frangia/core/run.h"

namespace frangia {

/// Where the files of a project are. A project is a scan folder with what was derived from it:
/// either a folder of the operator's app with project.json, or any scan folder with scan.toml. The
/// paths that its functions return lead through no link: where there is one, they throw
/// Error(Input), which names it, as `path_below`.
struct ProjectFolder {
  std::string name;               ///< for people: the name of the folder
  std::filesystem::path folder;   ///< absolute
  std::filesystem::path scan;     ///< scan folder; the same as `folder` for a plain scan folder
  std::filesystem::path derived;  ///< for surfaces, stations.json, clouds, exports

  /// A file or folder in `folder`.
  [[nodiscard]] std::filesystem::path in_folder(const std::filesystem::path& inner) const;
  /// A file or folder in `scan`.
  [[nodiscard]] std::filesystem::path in_scan(const std::filesystem::path& inner) const;
  /// A file or folder in `derived`.
  [[nodiscard]] std::filesystem::path in_derived(const std::filesystem::path& inner) const;
  /// Opens a file in `derived`.
  ///
  /// @errors   Error(Input) as `open_below`
  [[nodiscard]] FileDescriptor open_in_derived(const std::filesystem::path& inner,
                                               OpenFor use = OpenFor::Reading) const;
  /// Text of a JSON file in `derived`.
  ///
  /// @errors   Error(Input) as `read_json_below`
  [[nodiscard]] std::string read_json(const std::filesystem::path& inner,
                                      std::uint64_t max_bytes = 1'000'000) const;
  /// Rig with its devices that a scan is captured with.
  [[nodiscard]] std::filesystem::path rig() const { return in_folder("rig.toml"); }
  /// Settings of the capture, see read_capture_settings.
  [[nodiscard]] std::filesystem::path capture() const { return in_derived("capture.json"); }
  /// Names the surfaces, their edits and which is shown, JSON; each has a folder in `versions`. A
  /// project of an older program has none, but surface.ply in its place.
  [[nodiscard]] std::filesystem::path versions() const { return in_derived("versions.json"); }
  /// Quality of each station, JSON.
  [[nodiscard]] std::filesystem::path stations() const { return in_derived("stations.json"); }
  /// A reference of the surface, of a format that `set-reference` takes. Each one has the next
  /// number, so that it never takes the place of the one before; 0: that of an older program.
  [[nodiscard]] std::filesystem::path reference(const std::string& format, int number) const;
  /// The file in which a reference arrives.
  [[nodiscard]] std::filesystem::path reference_part() const {
    return in_derived("reference.part");
  }
  /// Name and format of the reference, JSON.
  [[nodiscard]] std::filesystem::path reference_name() const {
    return in_derived("reference.json");
  }
  /// How the surface is inspected: the plan that the page edits.
  [[nodiscard]] std::filesystem::path plan() const { return in_derived("inspection.toml"); }
  /// Poses of a board, see CalibrationWizard.
  [[nodiscard]] std::filesystem::path calibration() const { return in_derived("calibration"); }
  /// Views of a board that the turntable turns, see calibrate_axis.
  [[nodiscard]] std::filesystem::path axis() const { return in_derived("axis"); }
  /// Residuals of the calibration, JSON.
  [[nodiscard]] std::filesystem::path residuals() const { return in_derived("residuals.json"); }
  /// A small picture of the surface for the list of projects: PNG or JPEG.
  [[nodiscard]] std::filesystem::path thumbnail() const { return in_derived("thumbnail"); }
  /// What the user noted, plain text.
  [[nodiscard]] std::filesystem::path notes() const { return in_derived("notes.txt"); }
  /// Folder of the exported files.
  [[nodiscard]] std::filesystem::path exports() const { return in_derived("exports"); }
  /// Points of a station, packed by encode_points.
  [[nodiscard]] std::filesystem::path cloud(std::size_t station) const;
};

/// What a list of projects shows of one.
struct ProjectEntry {
  std::string name;              ///< name of its folder, unique in a library
  std::int64_t modified_s = 0;   ///< of its newest derived file, seconds since 1970
  bool scanned = false;          ///< its scan is complete
  bool has_surface = false;      ///< a surface was reconstructed
  std::int64_t thumbnail_s = 0;  ///< when its picture was written, seconds since 1970; 0: none
  std::string notes = {};        ///< of its user; may be empty
};

/// Recognizes the project in a folder.
///
/// @errors   Error(Input) that names the folder when it is neither a project nor a scan folder
[[nodiscard]] ProjectFolder project_in(const std::filesystem::path& folder);

/// What a library has in its bin.
struct DiscardedProjects {
  std::vector<std::string> names;  ///< sorted
  std::uintmax_t bytes = 0;        ///< size of all their files
};

/// The projects in one folder. Names that arrive from a network reach the file system through this
/// class only: `find` compares them with the folder's entries and never makes a path from them.
class ProjectLibrary {
 public:
  /// `root` is created when the first project is.
  explicit ProjectLibrary(std::filesystem::path root) : root_(std::move(root)) {}

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }  ///< the folder
  /// The projects, the most recent first. Entries that are no projects are left out.
  [[nodiscard]] std::vector<ProjectEntry> list() const;
  /// @errors   Error(Input) when there is no project of this name
  [[nodiscard]] ProjectFolder find(const std::string& name) const;
  /// Creates the folder of a project, with its project.json.
  ///
  /// @errors   Error(Input) for a name that is no plain file name of 1 to 60 bytes, or that is
  ///          taken; Error(File) when the folder cannot be written
  [[nodiscard]] ProjectFolder create(const std::string& name) const;
  /// Gives a project another name.
  ///
  /// @errors   as `find` and `create`; Error(Input) while another process has it open or captures
  ///          its scan
  void rename(const std::string& name, const std::string& to) const;
  /// Copies a project, without links. The copy appears when it is complete.
  ///
  /// `open_here`: this process has the project open and does not change it meanwhile
  /// @errors   as `find` and `create`; Error(Input) while another process has it open; Error(File)
  ///          when it cannot be written; Error(Cancelled)
  void duplicate(const std::string& name,
                 const std::string& copy,
                 const Run& run,
                 bool open_here = false) const;
  /// Moves a project into the bin.
  ///
  /// @errors   as `find`; Error(Input) while another process has it open or captures its scan, or
  ///          when the bin is a link
  void discard(const std::string& name) const;
  /// Folder of what was deleted.
  [[nodiscard]] std::filesystem::path bin() const;
  /// Names of the projects in the bin, sorted.
  [[nodiscard]] std::vector<std::string> discarded() const;
  /// Brings a project back from the bin. Returns its name, which has a number where that of the
  /// bin is taken.
  ///
  /// @errors   Error(Input) when the bin holds none of this name
  std::string take_back(const std::string& name) const;
  /// The names with the size of their files; links are not followed.
  [[nodiscard]] DiscardedProjects in_bin() const;
  /// Deletes projects of the bin for good, and what an interrupted deletion left. Nothing outside
  /// of the bin is deleted, and no project halfway: one that was begun is no project any more.
  ///
  /// @errors   Error(Input) when the bin holds none of a name, before anything is deleted, or is a
  ///          link; Error(File) when something cannot be deleted; Error(Cancelled)
  void empty_bin(const std::vector<std::string>& names, const Run& run) const;

 private:
  /// The folder of a name that no project has.
  [[nodiscard]] std::filesystem::path free_folder(const std::string& name) const;
  std::filesystem::path root_;
};

/// When a file or folder was last written, in seconds since 1970; 0 if that cannot be read.
[[nodiscard]] std::int64_t modified_s(const std::filesystem::path& path);

/// Checks the name of a new project.
///
/// @errors   Error(Input) that says what a name may hold
void check_project_name(const std::string& name);

}  // namespace frangia
