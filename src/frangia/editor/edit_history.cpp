#include "frangia/editor/edit_history.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <type_traits>

namespace frangia {

static_assert(std::is_nothrow_move_assignable_v<EditHistory>,
              "a history that was prepared becomes the present one without failing");

EditHistory EditHistory::applied(const EditStep& step, const Run& run) const {
  EditHistory next = *this;
  apply_step(next.state_, step, run);
  next.deltas_.resize(done_);
  next.steps_.resize(done_);
  next.deltas_.push_back(std::make_shared<const MeshDelta>(state_, next.state_));
  next.steps_.push_back(step);
  ++next.done_;
  return next;
}

EditHistory EditHistory::undone() const {
  EditHistory next = *this;
  static_cast<void>(next.undo());
  return next;
}

EditHistory EditHistory::redone() const {
  EditHistory next = *this;
  static_cast<void>(next.redo());
  return next;
}

void EditHistory::apply(const EditStep& step, const Run& run) {
  *this = applied(step, run);
}

bool EditHistory::undo() {
  if (done_ == 0) return false;
  deltas_[--done_]->undo(state_);
  return true;
}

bool EditHistory::redo() {
  if (done_ == deltas_.size()) return false;
  deltas_[done_++]->redo(state_);
  return true;
}

std::size_t EditHistory::bytes() const {
  std::size_t sum = 0;
  for (const auto& delta : deltas_)
    sum += delta->bytes();
  return sum;
}

namespace {

constexpr std::size_t kBlock = 256;  // bytes that are stored together when one of them differs

template <typename T>
std::span<const std::uint8_t> bytes_of(const std::vector<T>& array) {
  return {reinterpret_cast<const std::uint8_t*>(array.data()),  // NOLINT(*-reinterpret-cast)
          array.size() * sizeof(T)};
}

/// The length of the common prefix of two arrays in bytes.
std::size_t common_prefix(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  const std::size_t most = std::min(a.size(), b.size());
  std::size_t same = 0;
  while (same + kBlock <= most && std::memcmp(&a[same], &b[same], kBlock) == 0)
    same += kBlock;
  while (same < most && a[same] == b[same])
    ++same;
  return same;
}

std::vector<std::uint8_t> copy_of(std::span<const std::uint8_t> bytes) {
  return {bytes.begin(), bytes.end()};
}

}  // namespace

template <typename T>
MeshDelta::ArrayDelta MeshDelta::compare(const std::vector<T>& before,
                                         const std::vector<T>& after) {
  // Eigen's vectors are not trivially copyable, but hold three floats.
  static_assert(std::is_trivially_copyable_v<T> || sizeof(T) == sizeof(Eigen::Vector3f));
  const auto a = bytes_of(before);
  const auto b = bytes_of(after);
  ArrayDelta delta{.before_bytes = a.size(), .after_bytes = b.size(), .runs = {}};
  if (a.size() != b.size()) {
    const std::size_t same = common_prefix(a, b);
    delta.runs.push_back({same, copy_of(a.subspan(same)), copy_of(b.subspan(same))});
    return delta;
  }
  for (std::size_t begin = 0; begin < a.size(); begin += kBlock) {
    const std::size_t size = std::min(kBlock, a.size() - begin);
    if (std::memcmp(&a[begin], &b[begin], size) == 0) continue;
    const bool extends_last =
        !delta.runs.empty() && delta.runs.back().offset + delta.runs.back().before.size() == begin;
    if (!extends_last) delta.runs.push_back({begin, {}, {}});
    Run& run = delta.runs.back();
    const auto old = a.subspan(begin, size);
    const auto fresh = b.subspan(begin, size);
    run.before.insert(run.before.end(), old.begin(), old.end());
    run.after.insert(run.after.end(), fresh.begin(), fresh.end());
  }
  return delta;
}

template <typename T>
void MeshDelta::patch(std::vector<T>& array, const ArrayDelta& delta, bool back) {
  array.resize((back ? delta.before_bytes : delta.after_bytes) / sizeof(T));
  for (const Run& run : delta.runs) {
    const auto& bytes = back ? run.before : run.after;
    if (bytes.empty()) continue;
    auto* const begin =
        reinterpret_cast<std::uint8_t*>(array.data()) + run.offset;  // NOLINT(*-reinterpret-cast)
    std::copy(bytes.begin(), bytes.end(), begin);
  }
}

MeshDelta::MeshDelta(const EditState& before, const EditState& after)
    : combine_before_(before.combine),
      combine_after_(after.combine),
      sigmas_before_(before.max_sigmas),
      sigmas_after_(after.max_sigmas) {
  arrays_.push_back(compare(before.mesh.vertices_mm, after.mesh.vertices_mm));
  arrays_.push_back(compare(before.mesh.triangles, after.mesh.triangles));
  arrays_.push_back(compare(before.mesh.normals, after.mesh.normals));
  arrays_.push_back(compare(before.mesh.sigma_mm, after.mesh.sigma_mm));
  arrays_.push_back(compare(before.mesh.views, after.mesh.views));
  arrays_.push_back(compare(before.mesh.vertex_marks, after.mesh.vertex_marks));
  arrays_.push_back(compare(before.mesh.triangle_marks, after.mesh.triangle_marks));
  arrays_.push_back(compare(before.selection, after.selection));
  arrays_.push_back(compare(before.mesh.sigma_noise_mm, after.mesh.sigma_noise_mm));
  arrays_.push_back(compare(before.mesh.sigma_systematic_mm, after.mesh.sigma_systematic_mm));
  arrays_.push_back(compare(before.mesh.colors, after.mesh.colors));
}

void MeshDelta::apply(EditState& state, bool back) const {
  patch(state.mesh.vertices_mm, arrays_[0], back);
  patch(state.mesh.triangles, arrays_[1], back);
  patch(state.mesh.normals, arrays_[2], back);
  patch(state.mesh.sigma_mm, arrays_[3], back);
  patch(state.mesh.views, arrays_[4], back);
  patch(state.mesh.vertex_marks, arrays_[5], back);
  patch(state.mesh.triangle_marks, arrays_[6], back);
  patch(state.selection, arrays_[7], back);
  patch(state.mesh.sigma_noise_mm, arrays_[8], back);
  patch(state.mesh.sigma_systematic_mm, arrays_[9], back);
  patch(state.mesh.colors, arrays_[10], back);
  state.combine = back ? combine_before_ : combine_after_;
  state.max_sigmas = back ? sigmas_before_ : sigmas_after_;
}

void MeshDelta::undo(EditState& state) const {
  apply(state, true);
}

void MeshDelta::redo(EditState& state) const {
  apply(state, false);
}

std::size_t MeshDelta::bytes() const {
  std::size_t sum = 0;
  for (const ArrayDelta& array : arrays_) {
    for (const Run& run : array.runs)
      sum += run.before.size() + run.after.size();
  }
  return sum;
}

}  // namespace frangia
