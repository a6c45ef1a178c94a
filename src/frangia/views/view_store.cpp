#include "frangia/views/view_store.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"

namespace frangia {
namespace {

std::string temporary_folder() {
  const char* folder = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): nothing sets it
  return folder != nullptr ? folder : "/tmp";
}

[[noreturn]] void fail_to_store(int error) {
  throw Error(ErrorKind::File,
              "the views cannot be stored in the temporary folder " + temporary_folder() + " (" +
                  std::strerror(error) +  // NOLINT(concurrency-mt-unsafe)
                  "); free some space, or set TMPDIR to a folder on a larger disk");
}

std::FILE* open_unnamed() {
  std::string path = temporary_folder() + "/frangia-views-XXXXXX";
  const int descriptor = ::mkstemp(path.data());
  if (descriptor < 0) fail_to_store(errno);
  ::unlink(path.c_str());  // the file lives as long as it is open
  return ::fdopen(descriptor, "w+b");
}

/// Reads or writes consecutive blocks of the file from an offset on.
class Cursor {
 public:
  Cursor(std::FILE* file, std::int64_t offset) : descriptor_(::fileno(file)), offset_(offset) {}

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const auto wrote = ::pwrite(descriptor_, bytes.data(), bytes.size(), offset_);
      if (wrote <= 0) fail_to_store(errno);
      bytes = bytes.subspan(static_cast<std::size_t>(wrote));
      offset_ += wrote;
    }
  }
  void read(std::span<std::byte> bytes) {
    while (!bytes.empty()) {
      const auto got = ::pread(descriptor_, bytes.data(), bytes.size(), offset_);
      if (got <= 0) {
        throw Error(ErrorKind::File,
                    "a view cannot be read back from the temporary folder " + temporary_folder() +
                        "; check its disk, or set TMPDIR to a folder on another one");
      }
      bytes = bytes.subspan(static_cast<std::size_t>(got));
      offset_ += got;
    }
  }
  void skip(std::size_t bytes) { offset_ += static_cast<std::int64_t>(bytes); }
  [[nodiscard]] std::int64_t offset() const { return offset_; }

 private:
  int descriptor_;
  std::int64_t offset_;
};

}  // namespace

ViewStore::ViewStore() : file_(open_unnamed()) {}
ViewStore::ViewStore(ViewStore&& other) noexcept
    : entries_(std::move(other.entries_)),
      file_(std::exchange(other.file_, nullptr)),
      end_(other.end_) {}
ViewStore& ViewStore::operator=(ViewStore&& other) noexcept {
  std::swap(entries_, other.entries_);
  std::swap(file_, other.file_);
  std::swap(end_, other.end_);
  return *this;
}
ViewStore::~ViewStore() {
  if (file_ != nullptr) static_cast<void>(std::fclose(file_));  // NOLINT(*-owning-memory)
}

std::int64_t ViewStore::write(const View& view, std::int64_t offset) {
  const RangeGrid& range = view.range;
  require(same_size(range.depth_mm, range.sigma_mm) &&
              (range.phase_rad.empty() || same_size(range.depth_mm, range.phase_rad)),
          "ViewStore: the images of the range grid differ in size");
  Cursor cursor(file_, offset);
  cursor.write(std::as_bytes(range.depth_mm.pixels()));
  cursor.write(std::as_bytes(range.sigma_mm.pixels()));
  cursor.write(std::as_bytes(range.phase_rad.pixels()));
  cursor.write(std::as_bytes(std::span(view.edge_pixels)));
  return cursor.offset();
}

void ViewStore::add(const View& view) {
  const Image<float>& depth = view.range.depth_mm;
  const bool has_phase = !view.range.phase_rad.empty();
  const Entry entry{view.rig_from_object,
                    depth.width(),
                    depth.height(),
                    has_phase,
                    view.edge_pixels.size(),
                    end_};
  end_ = write(view, end_);
  entries_.push_back(entry);
}

void ViewStore::replace(std::size_t index, const View& view) {
  Entry& entry = entries_.at(index);
  require(
      view.range.depth_mm.width() == entry.width && view.range.depth_mm.height() == entry.height,
      "ViewStore::replace: the grid has another size");
  require(!view.range.phase_rad.empty() == entry.has_phase,
          "ViewStore::replace: the grid must have a phase image exactly when it had one before");
  require(view.edge_pixels.size() <= entry.edge_pixels,
          "ViewStore::replace: the view has more edge pixels than before");
  write(view, entry.offset);
  entry.rig_from_object = view.rig_from_object;
  entry.edge_pixels = view.edge_pixels.size();
}

void ViewStore::clear(std::size_t index) {
  View view = load(index);
  for (Image<float>* image : {&view.range.depth_mm, &view.range.sigma_mm, &view.range.phase_rad})
    std::fill(image->pixels().begin(), image->pixels().end(), kMissing);
  view.edge_pixels.clear();
  replace(index, view);
}

View ViewStore::load(std::size_t index) const {
  return read(index, true);
}

View ViewStore::load_points(std::size_t index) const {
  return read(index, false);
}

Image<float> ViewStore::load_depth_mm(std::size_t index) const {
  const Entry& entry = entries_.at(index);
  Image<float> depth(entry.width, entry.height, Uninitialized{});
  Cursor(file_, entry.offset).read(std::as_writable_bytes(depth.pixels()));
  return depth;
}

View ViewStore::read(std::size_t index, bool with_phase) const {
  const Entry& entry = entries_.at(index);
  View view;
  view.rig_from_object = entry.rig_from_object;
  view.edge_pixels.resize(entry.edge_pixels);
  view.range.depth_mm = Image<float>(entry.width, entry.height, Uninitialized{});
  view.range.sigma_mm = Image<float>(entry.width, entry.height, Uninitialized{});
  Cursor cursor(file_, entry.offset);
  cursor.read(std::as_writable_bytes(view.range.depth_mm.pixels()));
  cursor.read(std::as_writable_bytes(view.range.sigma_mm.pixels()));
  if (entry.has_phase && with_phase) {
    view.range.phase_rad = Image<float>(entry.width, entry.height, Uninitialized{});
    cursor.read(std::as_writable_bytes(view.range.phase_rad.pixels()));
  } else if (entry.has_phase) {
    cursor.skip(view.range.depth_mm.pixels().size_bytes());
  }
  cursor.read(std::as_writable_bytes(std::span(view.edge_pixels)));
  return view;
}

}  // namespace frangia
