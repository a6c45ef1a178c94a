#include "frangia/views/view_store.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <future>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/range/measured_volume.h"

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

 private:
  int descriptor_;
  std::int64_t offset_;
};

bool are_equal(const CameraModel& a, const CameraModel& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && a.focal_px == b.focal_px &&
         a.principal_point_px == b.principal_point_px && a.distortion == b.distortion;
}

std::size_t pixels_in(const PixelBox& box) {
  return static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height());
}

/// Writes the pixels of a box, row by row; `buffer` lends its memory.
template <typename T>
void write_box(const Image<T>& image, const PixelBox& box, std::vector<T>& buffer, Cursor& cursor) {
  if (image.empty() || box.empty()) return;
  buffer.resize(pixels_in(box));
  T* to = buffer.data();
  for (int y = box.top; y < box.bottom; ++y)
    to = std::copy_n(&image(box.left, y), box.width(), to);
  cursor.write(std::as_bytes(std::span(buffer)));
}

/// Reads an image of which the file holds the pixels of a box; the others become `missing`.
template <typename T>
Image<T> read_box(
    int width, int height, const PixelBox& box, T missing, std::vector<T>& buffer, Cursor& cursor) {
  if (box.empty()) return {width, height, missing};
  Image<T> image(width, height, Uninitialized{});
  buffer.resize(pixels_in(box));
  cursor.read(std::as_writable_bytes(std::span(buffer)));
  T* to = image.pixels().data();
  const T* from = buffer.data();
  for (int y = 0; y < height; ++y) {
    const bool within = y >= box.top && y < box.bottom;
    to = std::fill_n(to, within ? box.left : width, missing);
    if (!within) continue;
    to = std::copy_n(from, box.width(), to);
    from += box.width();
    to = std::fill_n(to, width - box.right, missing);
  }
  return image;
}

}  // namespace

ViewStore::ViewStore() : file_(open_unnamed()) {}
ViewStore::ViewStore(ViewStore&& other) noexcept
    : entries_(std::move(other.entries_)),
      rays_(std::move(other.rays_)),
      file_(std::exchange(other.file_, nullptr)),
      end_(other.end_) {}
ViewStore& ViewStore::operator=(ViewStore&& other) noexcept {
  std::swap(entries_, other.entries_);
  std::swap(rays_, other.rays_);
  std::swap(file_, other.file_);
  std::swap(end_, other.end_);
  return *this;
}
ViewStore::~ViewStore() {
  if (file_ != nullptr) static_cast<void>(std::fclose(file_));  // NOLINT(*-owning-memory)
}

void ViewStore::write(const View& view, Entry& entry) {
  const RangeGrid& range = view.range;
  require(same_size(range.depth_mm, range.sigma_mm) &&
              (range.phase_rad.empty() || same_size(range.depth_mm, range.phase_rad)) &&
              (range.systematic_mm.empty() || same_size(range.depth_mm, range.systematic_mm)) &&
              (view.color.empty() || same_size(range.depth_mm, view.color)),
          "ViewStore: the images of the range grid differ in size");
  entry.box = measured_box(range.depth_mm);
  entry.edge_pixels = view.edge_pixels.size();
  entry.differing_share = range.differing_share;
  const std::size_t images =
      2U + (range.phase_rad.empty() ? 0U : 1U) + (range.systematic_mm.empty() ? 0U : 1U);
  const std::size_t color_bytes = view.color.empty() ? 0U : sizeof(PixelColor);
  const auto bytes =
      static_cast<std::int64_t>((images * sizeof(float) + color_bytes) * pixels_in(entry.box) +
                                std::span(view.edge_pixels).size_bytes());
  if (bytes > entry.reserved) {
    entry.offset = end_;
    entry.reserved = bytes;
    end_ += bytes;
  }
  Cursor cursor(file_, entry.offset);
  std::vector<float> buffer;
  for (const Image<float>* image :
       {&range.depth_mm, &range.sigma_mm, &range.phase_rad, &range.systematic_mm})
    write_box(*image, entry.box, buffer, cursor);
  cursor.write(std::as_bytes(std::span(view.edge_pixels)));
  std::vector<PixelColor> colors;
  write_box(view.color, entry.box, colors, cursor);
}

void ViewStore::add(const View& view) {
  const Image<float>& depth = view.range.depth_mm;
  Entry entry;
  entry.rig_from_object = view.rig_from_object;
  entry.width = depth.width();
  entry.height = depth.height();
  entry.has_phase = !view.range.phase_rad.empty();
  entry.has_systematic = !view.range.systematic_mm.empty();
  entry.has_color = !view.color.empty();
  write(view, entry);
  entries_.push_back(entry);
}

void ViewStore::replace(std::size_t index, const View& view) {
  Entry& entry = entries_.at(index);
  require(
      view.range.depth_mm.width() == entry.width && view.range.depth_mm.height() == entry.height,
      "ViewStore::replace: the grid has another size");
  require(!view.range.phase_rad.empty() == entry.has_phase,
          "ViewStore::replace: the grid must have a phase image exactly when it had one before");
  require(
      !view.range.systematic_mm.empty() == entry.has_systematic,
      "ViewStore::replace: the grid must have a systematic part exactly when it had one before");
  require(!view.color.empty() == entry.has_color,
          "ViewStore::replace: the view must have colors exactly when it had them before");
  require(view.edge_pixels.size() <= entry.edge_pixels,
          "ViewStore::replace: the view has more edge pixels than before");
  write(view, entry);
  entry.rig_from_object = view.rig_from_object;
}

void ViewStore::clear(std::size_t index) {
  Entry& entry = entries_.at(index);
  entry.box = {0, 0, 0, 0};
  entry.edge_pixels = 0;
}

View ViewStore::load(std::size_t index) const {
  return read(index, {});
}

View ViewStore::load_points(std::size_t index, PointSigma sigma) const {
  return read(index,
              {.phase = false, .systematic = sigma == PointSigma::BothParts, .color = false});
}

View ViewStore::load_colored_points(std::size_t index) const {
  return read(index, {.phase = false, .systematic = false});
}

bool ViewStore::has_color() const {
  return std::any_of(
      entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.has_color; });
}

bool ViewStore::has_systematic() const {
  return std::any_of(
      entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.has_systematic; });
}

std::shared_ptr<const Image<Eigen::Vector2f>> ViewStore::rays(const CameraModel& camera) const {
  if (rays_.of_pixels == nullptr || !are_equal(rays_.camera, camera)) {
    rays_ = {camera, nullptr};  // frees the memory of the other camera's rays first
    rays_.of_pixels = std::make_shared<const Image<Eigen::Vector2f>>(rays_of(camera));
  }
  return rays_.of_pixels;
}

Image<float> ViewStore::load_depth_mm(std::size_t index) const {
  const Entry& entry = entries_.at(index);
  Cursor cursor(file_, entry.offset);
  std::vector<float> buffer;
  return read_box(entry.width, entry.height, entry.box, kMissing, buffer, cursor);
}

View ViewStore::read(std::size_t index, const OptionalImages& wanted) const {
  const Entry& entry = entries_.at(index);
  View view;
  view.rig_from_object = entry.rig_from_object;
  view.edge_pixels.resize(entry.edge_pixels);
  view.range.differing_share = entry.differing_share;
  Cursor cursor(file_, entry.offset);
  std::vector<float> buffer;
  const auto next_image = [&] {
    return read_box(entry.width, entry.height, entry.box, kMissing, buffer, cursor);
  };
  view.range.depth_mm = next_image();
  view.range.sigma_mm = next_image();
  const auto next_optional = [&](bool stored, bool wants, Image<float>& image) {
    if (stored && wants) {
      image = next_image();
    } else if (stored) {
      cursor.skip(sizeof(float) * pixels_in(entry.box));
    }
  };
  next_optional(entry.has_phase, wanted.phase, view.range.phase_rad);
  next_optional(entry.has_systematic, wanted.systematic, view.range.systematic_mm);
  cursor.read(std::as_writable_bytes(std::span(view.edge_pixels)));
  if (entry.has_color && wanted.color) {
    std::vector<PixelColor> colors;
    view.color = read_box(entry.width, entry.height, entry.box, PixelColor{}, colors, cursor);
  }
  return view;
}

void load_each_view(const ViewStore& views,
                    const std::function<void(std::size_t index, View& view)>& use,
                    PointSigma sigma) {
  const auto load = [&](std::size_t i) {
    return std::async(std::launch::async,
                      [&views, i, sigma] { return views.load_points(i, sigma); });
  };
  std::future<View> next;
  for (std::size_t i = 0; i < views.size(); ++i) {
    View view = i == 0 ? views.load_points(0, sigma) : next.get();
    if (i + 1 < views.size()) next = load(i + 1);
    use(i, view);
  }
}

PointCloud collect_points(const ViewStore& views,
                          const CameraModel& camera,
                          const Run& run,
                          std::span<const SigmaTerm> terms,
                          std::size_t camera_index) {
  const auto rays = rays_of(camera);
  const bool has_systematic = views.has_systematic() || !terms.empty();
  PointCloud cloud;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.check();
    View view = views.load_points(i, PointSigma::BothParts);
    add_terms(view, camera_index, terms);
    require(same_size(view.range.depth_mm, rays),
            "collect_points: a view and the camera differ in size");
    const Eigen::Isometry3d object_from_rig = view.rig_from_object.inverse();
    for (std::size_t pixel = 0; pixel < rays.pixels().size(); ++pixel) {
      const float depth = view.range.depth_mm.pixels()[pixel];
      if (std::isnan(depth)) continue;
      const Eigen::Vector3f seen = depth * rays.pixels()[pixel].homogeneous();
      cloud.points_mm.emplace_back((object_from_rig * seen.cast<double>()).cast<float>());
      cloud.sigma_mm.push_back(view.range.sigma_mm.pixels()[pixel]);
      if (!has_systematic) continue;
      cloud.systematic_mm.push_back(
          view.range.systematic_mm.empty() ? 0.0F : view.range.systematic_mm.pixels()[pixel]);
    }
  }
  return cloud;
}

}  // namespace frangia
