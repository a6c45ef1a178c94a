#include "frangia/views/view_store.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"

namespace frangia {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorKind::File,
              "the temporary folder cannot hold the views (" + what +
                  "); free some space, or set TMPDIR to a folder on a larger disk");
}

std::FILE* open_unnamed() {
  const char* folder = std::getenv("TMPDIR");  // NOLINT(concurrency-mt-unsafe): nothing sets it
  std::string path = std::string(folder != nullptr ? folder : "/tmp") + "/frangia-views-XXXXXX";
  const int descriptor = ::mkstemp(path.data());
  if (descriptor < 0) fail(std::strerror(errno));  // NOLINT(concurrency-mt-unsafe)
  ::unlink(path.c_str());                          // the file lives as long as it is open
  return ::fdopen(descriptor, "w+b");
}

/// Reads or writes consecutive blocks of the file from an offset on.
class Cursor {
 public:
  Cursor(std::FILE* file, std::int64_t offset) : descriptor_(::fileno(file)), offset_(offset) {}

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const auto wrote = ::pwrite(descriptor_, bytes.data(), bytes.size(), offset_);
      if (wrote <= 0) fail(std::strerror(errno));  // NOLINT(concurrency-mt-unsafe)
      bytes = bytes.subspan(static_cast<std::size_t>(wrote));
      offset_ += wrote;
    }
  }
  void read(std::span<std::byte> bytes) {
    while (!bytes.empty()) {
      const auto got = ::pread(descriptor_, bytes.data(), bytes.size(), offset_);
      if (got <= 0) fail("a view could not be read back");
      bytes = bytes.subspan(static_cast<std::size_t>(got));
      offset_ += got;
    }
  }
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
  Cursor cursor(file_, offset);
  cursor.write(std::as_bytes(view.range.depth_mm.pixels()));
  cursor.write(std::as_bytes(view.range.sigma_mm.pixels()));
  cursor.write(std::as_bytes(std::span(view.edge_pixels)));
  return cursor.offset();
}

void ViewStore::add(const View& view) {
  const Image<float>& depth = view.range.depth_mm;
  const Entry entry{
      view.rig_from_object, depth.width(), depth.height(), view.edge_pixels.size(), end_};
  end_ = write(view, end_);
  entries_.push_back(entry);
}

void ViewStore::replace(std::size_t index, const View& view) {
  Entry& entry = entries_.at(index);
  require(
      view.range.depth_mm.width() == entry.width && view.range.depth_mm.height() == entry.height,
      "ViewStore::replace: the grid has another size");
  require(view.edge_pixels.size() <= entry.edge_pixels,
          "ViewStore::replace: it has more edge pixels than before");
  entry.rig_from_object = view.rig_from_object;
  entry.edge_pixels = view.edge_pixels.size();
  write(view, entry.offset);
}

void ViewStore::clear(std::size_t index) {
  View view = load(index);
  std::fill(view.range.depth_mm.pixels().begin(), view.range.depth_mm.pixels().end(), kMissing);
  view.edge_pixels.clear();
  replace(index, view);
}

View ViewStore::load(std::size_t index) const {
  const Entry& entry = entries_.at(index);
  View view;
  view.rig_from_object = entry.rig_from_object;
  view.edge_pixels.resize(entry.edge_pixels);
  view.range.depth_mm = Image<float>(entry.width, entry.height, Uninitialized{});
  view.range.sigma_mm = Image<float>(entry.width, entry.height, Uninitialized{});
  Cursor cursor(file_, entry.offset);
  cursor.read(std::as_writable_bytes(view.range.depth_mm.pixels()));
  cursor.read(std::as_writable_bytes(view.range.sigma_mm.pixels()));
  cursor.read(std::as_writable_bytes(std::span(view.edge_pixels)));
  return view;
}

}  // namespace frangia
