#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/dataset/import_frames.h"
#include "frangia/dataset/name_template.h"

namespace frangia {

/// A file that fits the template.
struct NamedFile {
  std::filesystem::path path;
  std::string name;  ///< relative to the folder
  NameFields fields;
  std::size_t pages = 1;
};

/// One image of a file.
struct NamedImage {
  std::size_t file = 0;  ///< index into the files
  std::size_t page = 0;
};

/// The images of one view and pattern, by their numbers.
using ImageSequence = std::map<int, NamedImage>;

/// Throws Error(Input).
[[noreturn]] void refuse_import(const std::string& sentence);

/// The names of the images in a folder or at most two subfolders down: the most that have one
/// extension and one depth. With `raw`, any extension is that of an image, in the folder itself.
///
/// @errors   Error(Input) that names a folder without images
[[nodiscard]] std::vector<std::string> images_below(const std::filesystem::path& folder, bool raw);

/// The files below a folder that fit the template. A note counts the images that do not.
///
/// @errors   Error(Input) when no file fits, or a file fits in two ways
[[nodiscard]] std::vector<NamedFile> matching_files(const std::filesystem::path& folder,
                                                    const NameTemplate& names,
                                                    const std::vector<std::string>& patterns,
                                                    const Run& run);

/// Opens every file, several at a time: sets the numbers of pages, and `plan.image` and
/// `plan.jpeg_quality`.
///
/// @errors   Error(Input) that names a file of another size or depth, or in colour without a choice
void check_images(std::vector<NamedFile>& files, ImportPlan& plan, const Run& run);

/// The images of each view and pattern. A page is a further frame of its file.
///
/// @errors   Error(Input) that names two files of one frame, or a file of several frames whose name
///          states one
[[nodiscard]] std::map<int, std::map<std::string, ImageSequence>> sequences_of(
    const std::vector<NamedFile>& files);

/// Splits files by their cameras, the reference camera first: sets the names of `plan.cameras`.
///
/// @errors   Error(Input) that names a camera that the rig of the options does not hold, or that
///          the folder does not
[[nodiscard]] std::vector<std::vector<NamedFile>> files_of_cameras(std::vector<NamedFile> files,
                                                                   ImportPlan& plan);

/// Assigns the images of view number `view` and a camera to the frames of the plan's patterns, or
/// to those of `layout`, the sequence of another program, if it is given.
///
/// @errors   Error(Input) that names a missing or surplus frame
void assign_frames(ImportPlan& plan,
                   std::size_t view,
                   std::size_t camera,
                   const std::map<std::string, ImageSequence>& images,
                   const std::vector<NamedFile>& files,
                   const ImportLayout* layout);

}  // namespace frangia
