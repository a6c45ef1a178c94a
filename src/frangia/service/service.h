#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "frangia/core/file_descriptor.h"
#include "frangia/editor/edit_operation.h"
#include "frangia/rig/board.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/live_preview.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/project_scan.h"

namespace frangia {

/// How the present surface was inspected.
struct ProgressOfInspection {
  std::filesystem::path plan;       ///< its file; empty: none was made
  std::filesystem::path reference;  ///< its file; empty: none
  std::filesystem::path scan;       ///< whose rig the features hold; empty: none
  bool best_fit = true;             ///< otherwise as it stands
  bool chosen = false;              ///< the plan states which of the poses
  std::size_t start = 1;            ///< of the poses that fit alike, from 1
  std::size_t poses = 0;            ///< that fit alike
  double lower_mm = 0.0;            ///< tolerance
  double upper_mm = 0.0;            ///< tolerance
};

/// Of the last calibration of a project.
struct ProgressOfCalibration {
  std::filesystem::path poses;  ///< scan folder
  Board board;                  ///< in the poses
  std::size_t wanted = 0;       ///< poses
  bool solved = false;          ///< the rig is calibrated from them
};

/// How a surface is built from the scan.
struct BuildSettings {
  double voxel_mm = 0.0;          ///< sampling distance; 0: chosen from the data
  bool watertight = false;        ///< closes all holes
  std::size_t max_triangles = 0;  ///< decimates to this number; 0: keeps all
};

/// How far a project has come, for those who describe it in their own words.
struct ProjectProgress {
  ProjectFolder folder;                              ///< where its files are
  bool can_scan = false;                             ///< its rig names devices
  std::size_t stations = 0;                          ///< planned or captured, of the present setup
  int setup = 0;                                     ///< the present one
  bool scan_complete = false;                        ///< the scan can be reconstructed
  bool has_surface = false;                          ///< a surface was reconstructed and read
  std::filesystem::path surface{};                   ///< its file, before edits
  std::vector<EditStep> steps;                       ///< applied edits
  CaptureSettings capture;                           ///< of the scan
  BuildSettings build{};                             ///< as the surface was last built
  std::optional<ProgressOfInspection> inspection{};  ///< of the present surface
  std::optional<ProgressOfCalibration> calibration{};  ///< since the project was opened
};

/// Command lines by the name of the step that they stand for, as words.
using CommandLines = std::map<std::string, std::vector<std::string>>;

/// What a service needs to know of its program.
struct ServiceOptions {
  std::filesystem::path projects;  ///< folder of the projects
  CaptureSetup capture;            ///< drivers and the guardian
  std::string version;             ///< of the program, for the state
  /// Called when a live preview has a new picture, on any thread; may be empty.
  std::function<void()> on_picture;
  /// Makes a PDF file of an HTML page; empty: the program cannot. It throws Error(Input), which
  /// says what to install, where that is missing.
  std::function<void(const std::filesystem::path& page,
                     const std::filesystem::path& pdf,
                     const std::stop_token& stop)>
      print_page;
  /// Words the command lines that do the same as a project's steps; empty: the state has none.
  std::function<CommandLines(const ProjectProgress&)> command_lines;
};

/// A file that a client may download.
struct ExportedFile {
  std::string name;            ///< "bust.dxf"
  std::filesystem::path path;  ///< in the project's exports
  FileDescriptor file;         ///< opened for reading, not through a link
};

/// A packed message of a live preview.
struct LivePicture {
  std::uint64_t revision = 0;                ///< changes with each picture
  std::shared_ptr<const std::string> bytes;  ///< as encode_live packs them; null: nothing new
};

/// The operator's app without its network: one project at a time, its long tasks, its edit history
/// and what a client sees of them. Clients send commands and read the state and the arrays; all
/// functions may be called from any thread and return at once. docs/service-api.md describes the
/// JSON.
class Service {
 public:
  /// `on_change` is called after every change of the state, on any thread.
  Service(ServiceOptions options, std::function<void()> on_change);
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  Service(Service&&) = delete;
  Service& operator=(Service&&) = delete;
  /// Stops all tasks and waits for the present one.
  ~Service();

  /// Opens a project or a scan folder that the user of this machine named; not for names from a
  /// network. The surface is read in a job.
  ///
  /// @errors   Error(Input) when the folder is neither
  void open_folder(const std::filesystem::path& folder);

  /// Runs a command with its arguments as a JSON object and returns a JSON object. Long work is
  /// started as a job, whose number is returned as "job". A command whose argument "id" is that of
  /// one that was accepted before is not run again: its answer is returned.
  ///
  /// @errors   Error(Input) that names the command, the argument or what is missing; errors of the
  ///          command
  [[nodiscard]] std::string command(const std::string& name, const std::string& arguments);

  /// The whole state as a JSON object.
  [[nodiscard]] std::string state() const;
  /// The exact mesh of the surface as encode_mesh packs it; empty without one. It changes with
  /// "mesh_revision" of the state.
  [[nodiscard]] std::string mesh() const;
  /// A level of detail of the mesh as encode_level packs it, 0 the coarsest; empty without it.
  [[nodiscard]] std::string level(std::size_t level) const;
  /// The selected triangles as encode_selection packs them; empty without a surface.
  [[nodiscard]] std::string selection() const;
  /// The same for the triangles of a level of detail.
  [[nodiscard]] std::string selection(std::size_t level) const;
  /// The triangles that the previewed edit creates and removes; empty without a preview.
  [[nodiscard]] std::string preview() const;
  /// The deviations from the reference at the vertices of a level; empty without a comparison.
  [[nodiscard]] std::string deviations(std::size_t level) const;
  /// The reference as it is drawn, packed as a level; empty before the command `show-reference`.
  [[nodiscard]] std::string reference_picture() const;
  /// Adds a piece to the file that becomes the reference by the command `set-reference`; at offset
  /// 0 it starts over.
  ///
  /// @errors   Error(Input) when a piece is missing, or beyond 512 MB; Error(File) when it cannot
  ///          be written
  void add_to_reference(std::size_t offset, const std::string& bytes);
  /// The point of the exact mesh on a ray, as JSON: "hit" is null where there is none. The ray is
  /// a JSON object with "eye", "direction" and, if something is cut away, "section"; with
  /// "reference", the point is one of the reference.
  ///
  /// @errors   Error(Input) that names what is missing
  [[nodiscard]] std::string pick(const std::string& ray_json) const;
  /// The curves in which a plane cuts the exact mesh, as JSON. The plane is a JSON object with
  /// "point_mm" and "normal".
  ///
  /// @errors   Error(Input) that names what is missing
  [[nodiscard]] std::string section(const std::string& plane_json) const;
  /// The points of a station as encode_points packs them; empty without any.
  [[nodiscard]] std::string cloud(std::size_t station) const;
  /// The coarse surface of a scan that is captured, as encode_mesh packs it; empty without any.
  [[nodiscard]] std::string grown_surface() const;
  /// The registered points of a joined setup, counted from 0, as encode_points packs them; empty
  /// without any.
  [[nodiscard]] std::string setup_cloud(std::size_t joined) const;
  /// The newest picture of a live preview or of a calibration, unless it has the revision `after`.
  [[nodiscard]] LivePicture live_picture(LiveLayer layer, std::uint64_t after) const;
  /// The residuals of the open project's calibration as a JSON object.
  ///
  /// @errors   Error(Input) when no project is open, or it was not calibrated here
  [[nodiscard]] std::string residuals() const;
  /// The small picture of a project of the list, PNG or JPEG; empty without one.
  ///
  /// @errors   Error(Input) when there is no project of this name
  [[nodiscard]] std::string thumbnail(const std::string& name) const;
  /// A file that was exported.
  ///
  /// @errors   Error(Input) when there is no export of this name
  [[nodiscard]] ExportedFile exported(const std::string& name) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace frangia
