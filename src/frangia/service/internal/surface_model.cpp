#include "frangia/service/internal/surface_model.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <numeric>
#include <set>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/core/parallel.h"
#include "frangia/editor/edit_preview.h"
#include "frangia/editor/edit_script.h"
#include "frangia/features/feature_points.h"
#include "frangia/features/fit_points.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/service/internal/array_packer.h"
#include "frangia/service/internal/shown_inspection.h"

namespace frangia {
namespace {

template <typename T>
bool equal_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Whether clients need the mesh again.
bool same_picture(const Mesh& a, const Mesh& b) {
  return equal_bytes(a.triangles, b.triangles) && equal_bytes(a.vertices_mm, b.vertices_mm) &&
         equal_bytes(a.sigma_mm, b.sigma_mm) && equal_bytes(a.triangle_marks, b.triangle_marks) &&
         equal_bytes(a.vertex_marks, b.vertex_marks);
}

std::vector<SurfaceHole> holes_of(const Mesh& mesh) {
  std::vector<SurfaceHole> holes;
  const auto loops = boundary_loops(mesh);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    SurfaceHole hole{i, loops[i].size_mm, loops[i].length_mm, Eigen::Vector3d::Zero()};
    const auto vertices = vertices_of(mesh, loops[i]);
    for (const std::uint32_t vertex : vertices)
      hole.center_mm += mesh.vertices_mm[vertex].cast<double>();
    hole.center_mm /= static_cast<double>(vertices.size());
    holes.push_back(hole);
  }
  std::stable_sort(holes.begin(), holes.end(), [](const SurfaceHole& a, const SurfaceHole& b) {
    return a.size_mm > b.size_mm;
  });
  return holes;
}

ShapeKind shape_kind_of(const std::string& name) {
  for (const ShapeKind kind : {ShapeKind::Plane, ShapeKind::Cylinder, ShapeKind::Sphere})
    if (name == name_of(kind)) return kind;
  throw Error(ErrorKind::Input, "kind: is plane, cylinder or sphere");
}

/// What a sentence about an edit counts.
struct MeshCounts {
  std::size_t triangles = 0;
  std::size_t holes = 0;
  std::size_t components = 0;
};

MeshCounts counts_of(const Mesh& mesh) {
  return {mesh.triangles.size(),
          boundary_loops(mesh).size(),
          connected_components(mesh).components.size()};
}

MeshCounts counts_of(const SurfaceSnapshot& snapshot) {
  return {snapshot.triangles, snapshot.hole_count, snapshot.components};
}

StepChange change_of(const Mesh& mesh_before,
                     const MeshCounts& before,
                     const EditState& state,
                     const MeshCounts& after) {
  const auto more = [](std::size_t from, std::size_t to) {
    return static_cast<std::ptrdiff_t>(to) - static_cast<std::ptrdiff_t>(from);
  };
  StepChange change{.triangles = more(before.triangles, after.triangles),
                    .holes = more(before.holes, after.holes),
                    .components = more(before.components, after.components),
                    .selected = count_selected(state.selection)};
  const auto& from = mesh_before.vertices_mm;
  const auto& to = state.mesh.vertices_mm;
  if (change.triangles != 0 || from.size() != to.size()) return change;
  for (std::size_t i = 0; i < from.size(); ++i)
    if (from[i] != to[i]) ++change.moved;
  return change;
}

/// The triangles whose flag is set, with normals, as arrays whose names begin with a word.
void pack_part(ArrayPacker& packer, const std::string& word, Mesh part, const Selection& flags) {
  keep_triangles(part, flags);
  const auto normals = vertex_normals(part);
  constexpr std::size_t kCorners = 3;
  const auto add = [&](const char* name, const std::vector<Eigen::Vector3f>& vectors) {
    packer.add((word + name).c_str(),
               "float32",
               reinterpret_cast<const float*>(vectors.data()),
               vectors.size() * kCorners);
  };
  add("_positions", part.vertices_mm);
  add("_normals", normals);
  packer.add((word + "_triangles").c_str(),
             "uint32",
             reinterpret_cast<const std::uint32_t*>(part.triangles.data()),
             part.triangles.size() * kCorners);
}

/// The figures and the picture of a mesh.
void describe(const Mesh& mesh, SurfaceSnapshot& snapshot, const Run& run) {
  snapshot.vertices = mesh.vertices_mm.size();
  snapshot.triangles = mesh.triangles.size();
  const std::array<std::function<void()>, 2> tasks = {
      [&] {
        snapshot.picture =
            std::make_shared<const SurfacePicture>(mesh, snapshot.mesh_revision, run);
      },
      [&] {
        snapshot.holes = holes_of(mesh);
        snapshot.components = connected_components(mesh).components.size();
        snapshot.sigma = median_sigma(mesh);
      }};
  parallel_chunks(tasks.size(), 1, [&](std::size_t task, std::size_t) { tasks.at(task)(); });
  snapshot.hole_count = snapshot.holes.size();
  if (snapshot.holes.size() > SurfaceSnapshot::kMostHoles)
    snapshot.holes.resize(SurfaceSnapshot::kMostHoles);
}

/// Applies steps without pictures of what is in between. `fault` says what an error means.
void apply_all(EditHistory& history,
               const std::vector<EditStep>& steps,
               std::vector<StepChange>& changes,
               const char* fault,
               const Run& run) {
  MeshCounts before = counts_of(history.mesh());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(steps.size()));
    const Mesh mesh_before = history.mesh();
    try {
      history.apply(steps[i], {.stop = run.stop});
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::Cancelled) throw;
      throw Error(error.kind(),
                  fmt::format("{}: step {} is {} {}: {}",
                              fault,
                              i + 1,
                              steps[i].operation,
                              steps[i].value,
                              error.what()));
    }
    const MeshCounts after = equal_bytes(mesh_before.triangles, history.mesh().triangles)
                                 ? before
                                 : counts_of(history.mesh());
    changes.push_back(change_of(mesh_before, before, history.state(), after));
    before = after;
  }
}

/// The figures that a reconstruction left; empty where it left none. The surface can be shown
/// without.
std::string summary_in(const VersionFiles& files, const Run& run) {
  try {
    const auto file = files.summary();
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return {};
    return read_json_below(files.folder, file.filename());
  } catch (const Error& error) {
    run.warn(fmt::format("{}; the surface is shown without its figures", error.what()));
    return {};
  }
}

}  // namespace

static_assert(std::is_nothrow_move_assignable_v<SurfaceModel>,
              "a model that was prepared becomes the present one without failing");

SurfaceModel::SurfaceModel(const VersionFiles& files, int version, int revision, const Run& run) {
  EditHistory history(read_mesh(files.surface(), run));
  std::error_code ignored;
  if (std::filesystem::exists(files.edits, ignored)) {
    const EditScript script = read_edit_script(files.edits);
    apply_all(
        history, script.steps, changes_, "the saved edits do not suit the saved surface", run);
    for (std::size_t i = script.done; i < script.steps.size(); ++i)
      history.undo();
  }
  history_ = std::make_shared<const EditHistory>(std::move(history));
  auto first = std::make_shared<SurfaceSnapshot>();
  first->version = version;
  first->summary = std::make_shared<const std::string>(summary_in(files, run));
  snapshot_ = std::move(first);
  publish(revision, run);
}

SurfaceModel SurfaceModel::applied(const EditStep& step, int revision, const Run& run) const {
  SurfaceModel next = *this;
  next.history_ = std::make_shared<const EditHistory>(history_->applied(step, run));
  next.forget_undone();
  next.changes_.emplace_back();
  next.publish(revision, run);
  auto shown = std::make_shared<SurfaceSnapshot>(*next.snapshot_);
  next.changes_.back() =
      change_of(mesh(), counts_of(*snapshot_), next.history_->state(), counts_of(*shown));
  next.show(std::move(shown));
  return next;
}

SurfaceModel SurfaceModel::replayed(const std::vector<EditStep>& steps,
                                    int revision,
                                    const Run& run) const {
  SurfaceModel next = *this;
  next.forget_undone();
  EditHistory history = *history_;
  apply_all(history,
            steps,
            next.changes_,
            "the edits do not suit this surface, and nothing was changed",
            run);
  next.history_ = std::make_shared<const EditHistory>(std::move(history));
  next.publish(revision, run);
  return next;
}

SurfaceModel SurfaceModel::with_component_of(std::size_t triangle,
                                             int revision,
                                             const Run& run) const {
  require(triangle < mesh().triangles.size(), "the surface has no such triangle; pick another one");
  const auto number = connected_components(mesh()).component_of[triangle];
  return applied({"select-component", std::to_string(number)}, revision, run);
}

SurfaceModel SurfaceModel::with_fit(const std::string& kind, const Run& run) const {
  const Selection& selection = history_->state().selection;
  require(count_selected(selection) > 0, "nothing is selected; select the surface to be fitted");
  Mesh part = mesh();
  part.triangles.clear();
  part.triangle_marks.clear();
  for (std::size_t i = 0; i < selection.size(); ++i) {
    if (selection[i] == 0) continue;
    part.triangles.push_back(mesh().triangles[i]);
    if (!mesh().triangle_marks.empty()) part.triangle_marks.push_back(mesh().triangle_marks[i]);
  }
  const FeaturePoints points = feature_points_of(part, run);
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  const Feature found = fit_points(points, all, shape_kind_of(kind), run);
  const Shape& shape = found.fit.shape;
  auto next = std::make_shared<SurfaceSnapshot>(*snapshot_);
  next->fits.push_back({.kind = kind,
                        .center_mm = shape.center_mm,
                        .axis = shape.axis,
                        .diameter_mm = kind == "plane" ? kMissing : 2.0 * shape.radius_mm,
                        .u95_mm = found.uncertainty.u95_mm,
                        .rms_mm = found.fit.rms_mm,
                        .form_mm = found.fit.form_mm,
                        .points = found.fit.points});
  if (next->fits.size() > SurfaceSnapshot::kMostFits) next->fits.erase(next->fits.begin());
  SurfaceModel shown = *this;
  shown.show(std::move(next));
  return shown;
}

SurfaceModel SurfaceModel::with_preview(const EditStep& step, int count, const Run& run) const {
  EditState state = history_->state();
  apply_step(state, step, run);
  run.stage("preview");
  const EditPreview difference = edit_preview(mesh(), state.mesh, run);
  ArrayPacker packer;
  pack_part(packer, "added", state.mesh, difference.added);
  pack_part(packer, "removed", mesh(), difference.removed);
  auto shown = std::make_shared<SurfacePreview>();
  shown->step = step;
  shown->change = change_of(mesh(), counts_of(*snapshot_), state, counts_of(state.mesh));
  shown->revision = count;
  packer.set_values({{"revision", count}});
  shown->arrays = std::make_shared<const std::string>(packer.pack());
  auto next = std::make_shared<SurfaceSnapshot>(*snapshot_);
  next->preview = std::move(shown);
  SurfaceModel model = *this;
  model.show(std::move(next));
  return model;
}

SurfaceModel SurfaceModel::without_preview() const {
  auto next = std::make_shared<SurfaceSnapshot>(*snapshot_);
  next->preview.reset();
  SurfaceModel model = *this;
  model.show(std::move(next));
  return model;
}

SurfaceModel SurfaceModel::inspected(const InspectionRequest& asked,
                                     int count,
                                     const Run& run) const {
  auto next = std::make_shared<SurfaceSnapshot>(*snapshot_);
  next->inspection = shown_inspection(mesh(), asked, count, run);
  SurfaceModel model = *this;
  model.show(std::move(next));
  return model;
}

SurfaceModel SurfaceModel::undone(int revision, const Run& run) const {
  require(history_->done() > 0, "there is no step to undo");
  SurfaceModel next = *this;
  next.history_ = std::make_shared<const EditHistory>(history_->undone());
  next.publish(revision, run);
  return next;
}

SurfaceModel SurfaceModel::redone(int revision, const Run& run) const {
  require(history_->done() < history_->steps().size(), "there is no step to redo");
  SurfaceModel next = *this;
  next.history_ = std::make_shared<const EditHistory>(history_->redone());
  next.publish(revision, run);
  return next;
}

void SurfaceModel::publish(int revision, const Run& run) {
  const EditState& state = history_->state();
  const std::size_t done = history_->done();
  shown_.resize(history_->steps().size() + 1);
  auto next = std::make_shared<SurfaceSnapshot>();
  if (shown_[done]) {  // undone or done again: the picture is known
    *next = *shown_[done];
  } else if (snapshot_->picture && same_picture(snapshot_->picture->mesh(), state.mesh)) {
    *next = *snapshot_;
  } else {
    next->version = snapshot_->version;
    next->summary = snapshot_->summary;
    next->mesh_revision = revision;
    describe(state.mesh, *next, run);
  }
  next->preview.reset();
  if (!shown_[done] || *next->selection != state.selection) {
    next->selected = count_selected(state.selection);
    next->selection = std::make_shared<const Selection>(state.selection);
    next->selection_revision = revision;
  }
  show(std::move(next));
}

SurfaceModel SurfaceModel::refined(const Run& run) const {
  SurfaceModel finer = *this;
  auto next = std::make_shared<SurfaceSnapshot>(*snapshot_);
  next->picture = snapshot_->picture->refined(run);
  finer.show(std::move(next));
  return finer;
}

void SurfaceModel::show(std::shared_ptr<SurfaceSnapshot> next) {
  next->steps = history_->steps();
  next->done = history_->done();
  next->changes = changes_;
  snapshot_ = std::move(next);
  shown_[history_->done()] = snapshot_;
  forget_far_pictures();
}

void SurfaceModel::forget_undone() {
  shown_.resize(snapshot_->done + 1);
  changes_.resize(snapshot_->done);
}

void SurfaceModel::forget_far_pictures() {
  std::set<const SurfacePicture*> kept;
  std::size_t bytes = 0;
  const std::size_t done = history_->done();
  const auto consider = [&](SurfacePtr& one) {
    if (!one) return;
    if (kept.insert(one->picture.get()).second) bytes += one->picture->bytes();
    if (bytes > kMostPictureBytes) one.reset();
  };
  for (std::size_t away = 1; away < shown_.size(); ++away) {
    if (away <= done) consider(shown_[done - away]);
    if (done + away < shown_.size()) consider(shown_[done + away]);
  }
}

}  // namespace frangia
