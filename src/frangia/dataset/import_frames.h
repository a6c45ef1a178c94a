#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/core/run.h"
#include "frangia/dataset/import_layout.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/grey_image.h"
#include "frangia/frames/image_file.h"

namespace frangia {

/// A value for a pattern, or for the next one without a value if the name is empty.
struct PatternValue {
  std::string pattern;  ///< name of the pattern, or empty
  double value = 0.0;   ///< the value
};

/// Which pixels are the camera's, where a file states an orientation other than 1.
enum class FrameOrientation {
  ByRig,   ///< those that have the rig's size; refused where both have
  Stored,  ///< the pixels as the file stores them
  Shown    ///< the pixels as programs show them, which turn the image
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(FrameOrientation /*any*/) {
  return EnumNames<FrameOrientation, 2>{
      {{FrameOrientation::Stored, "stored"}, {FrameOrientation::Shown, "shown"}}};
}

/// How a folder of images is read as a scan.
struct ImportOptions {
  std::string names;               ///< template of the file names, see NameTemplate; empty: guessed
  std::string layout;              ///< name of a known layout; empty: none
  std::filesystem::path patterns;  ///< file with the [[pattern]] tables of scan.toml
  std::vector<PatternValue> fringes;    ///< fringes over the projector's width, without `patterns`
  std::vector<PatternValue> period_px;  ///< periods of the fringes, without `patterns`
  std::vector<double> shifts_rad;       ///< of each frame; empty: equal steps over 360°
  bool reverse_shifts = false;          ///< shifts of the opposite sign
  double origin_rad = 0.0;              ///< phase at the projector's first column
  std::vector<int> skip{};              ///< numbers of {frame} that are left out
  bool horizontal = false;              ///< the phase varies with the projector's row
  std::filesystem::path rig;            ///< rig.toml; empty: sizes alone are known
  std::optional<ProjectorSize> projector_px{};  ///< size of the projector, without `rig`
  std::vector<double> angles_rad;               ///< turntable angles of the views
  /// Text of {camera} of the reference camera; empty: the one that `rig` does not name, or the
  /// first.
  std::string reference;
  int white_level = 0;       ///< full scale of the frames; 0: from the frames
  double float_white = 0.0;  ///< full scale of floating-point frames; 0: from the frames
  ColorChoice color;         ///< how colour frames become grey
  /// Of frames whose EXIF data say that they are to be shown turned.
  FrameOrientation orientation = FrameOrientation::ByRig;
  ImageFileOptions files;  ///< raw layout, memory
};

/// One frame of the scan and where it comes from.
struct ImportedFrame {
  std::filesystem::path file;  ///< image file
  std::size_t page = 0;        ///< image in the file
  std::size_t pattern = 0;     ///< index into the patterns
  std::size_t frame = 0;       ///< frame of the pattern
  std::size_t view = 0;        ///< index of the view
  std::size_t camera = 0;      ///< index into `ImportPlan::cameras`
};

/// A camera of the images.
struct ImportedCamera {
  std::string name;  ///< text of {camera}; empty without that field
  ImageInfo image;   ///< size and type of its images, as they are imported
  int turned = 1;    ///< orientation by which they are turned; 1: imported as stored
};

/// What an import will do.
struct ImportPlan {
  std::filesystem::path folder;                 ///< folder or file with the images
  ImportOptions options;                        ///< as given
  std::string names;                            ///< template of the file names
  bool guessed = false;                         ///< the template was guessed
  Rig rig;                                      ///< of `options.rig`, or with the sizes alone
  bool rig_has_projector = false;               ///< the size of the projector is known
  std::vector<Pattern> patterns;                ///< in the order of the frames
  std::optional<Board> board{};                 ///< that all views show, by `options.patterns`
  std::optional<Artifact> artifact{};           ///< likewise
  std::size_t views = 1;                        ///< number of views
  std::vector<ImportedFrame> frames;            ///< view by view, pattern by pattern
  std::vector<std::filesystem::path> left_out;  ///< images that a scan does not hold
  ImageInfo image;                              ///< size and type of the reference camera's images
  std::vector<ImportedCamera> cameras;          ///< the reference camera first
  int jpeg_quality = 0;                         ///< the lowest of all JPEGs; 0: none is a JPEG
};

/// Finds the frames in a folder, and checks that they are complete and of one kind. `source` may
/// also be one file, such as a multi-page TIFF. With {camera} in the template, the images of
/// several cameras are imported together; each takes all frames of all views.
///
/// @errors   Error(Input) that names the file or option: a template that fits no file, or two files
///          for one frame; a missing frame number; frames of different sizes or depths; colour
///          without a choice; patterns that are not described or not in the folder; the errors of
///          ImageFile, read_rig and make_layout
[[nodiscard]] ImportPlan plan_import(const std::filesystem::path& source,
                                     const ImportOptions& options,
                                     const Run& run = {});

/// What an import wrote.
struct ImportResult {
  Scan scan;                         ///< as in the folder
  double compression_counts2 = 0.0;  ///< variance that JPEG adds, in counts of the scan
};

/// Writes a planned scan into the new folder `target`: rig.toml, scan.toml, the frames as PNG of 8
/// or 16 bits or as floating-point TIFF, without loss, and import.json, which lists each original
/// with its CRC-32 and codec.
///
/// The scan is made in a temporary folder, which is renamed at the end: it appears completely or
/// not at all.
/// @errors   Error(File) when `target` exists or cannot be written; Error(Input) of ImageFile and
///          grey_image; Error(Cancelled)
ImportResult import_frames(const ImportPlan& plan,
                           const std::filesystem::path& target,
                           const Run& run = {});

}  // namespace frangia
