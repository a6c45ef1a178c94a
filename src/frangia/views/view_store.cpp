#include "frangia/views/view_store.h"

#include <algorithm>
#include <cstring>
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

std::size_t bytes_of(const Image<float>& image) {
  return image.pixels().size() * sizeof(float);
}

void write_all(std::FILE* file, const Image<float>& image, std::int64_t offset) {
  const auto* data = reinterpret_cast<const char*>(image.pixels().data());  // NOLINT
  std::size_t done = 0;
  while (done < bytes_of(image)) {
    const auto wrote = ::pwrite(::fileno(file),
                                data + done,
                                bytes_of(image) - done,
                                offset + static_cast<std::int64_t>(done));
    if (wrote <= 0) fail(std::strerror(errno));  // NOLINT(concurrency-mt-unsafe)
    done += static_cast<std::size_t>(wrote);
  }
}

void read_all(std::FILE* file, Image<float>& image, std::int64_t offset) {
  auto* data = reinterpret_cast<char*>(image.pixels().data());  // NOLINT
  std::size_t done = 0;
  while (done < bytes_of(image)) {
    const auto got = ::pread(::fileno(file),
                             data + done,
                             bytes_of(image) - done,
                             offset + static_cast<std::int64_t>(done));
    if (got <= 0) fail("a view could not be read back");
    done += static_cast<std::size_t>(got);
  }
}

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
  if (file_ != nullptr) static_cast<void>(std::fclose(file_));
}

void ViewStore::write(const Entry& entry, const View& view) {
  write_all(file_, view.range.depth_mm, entry.offset);
  write_all(file_,
            view.range.sigma_mm,
            entry.offset + static_cast<std::int64_t>(bytes_of(view.range.depth_mm)));
}

void ViewStore::add(const View& view) {
  const Image<float>& depth = view.range.depth_mm;
  const Entry entry{view.rig_from_object, view.rim, depth.width(), depth.height(), end_};
  write(entry, view);
  end_ += static_cast<std::int64_t>(2 * bytes_of(depth));
  entries_.push_back(entry);
}

void ViewStore::replace(std::size_t index, const View& view) {
  Entry& entry = entries_.at(index);
  require(
      view.range.depth_mm.width() == entry.width && view.range.depth_mm.height() == entry.height,
      "ViewStore::replace: the grid has another size");
  entry.rig_from_object = view.rig_from_object;
  entry.rim = view.rim;
  write(entry, view);
}

void ViewStore::clear(std::size_t index) {
  View view = load(index);
  std::fill(view.range.depth_mm.pixels().begin(), view.range.depth_mm.pixels().end(), kMissing);
  view.rim.clear();
  replace(index, view);
}

View ViewStore::load(std::size_t index) const {
  const Entry& entry = entries_.at(index);
  View view;
  view.rig_from_object = entry.rig_from_object;
  view.rim = entry.rim;
  view.range.depth_mm = Image<float>(entry.width, entry.height, Unfilled{});
  view.range.sigma_mm = Image<float>(entry.width, entry.height, Unfilled{});
  read_all(file_, view.range.depth_mm, entry.offset);
  read_all(file_,
           view.range.sigma_mm,
           entry.offset + static_cast<std::int64_t>(bytes_of(view.range.depth_mm)));
  return view;
}

}  // namespace frangia
