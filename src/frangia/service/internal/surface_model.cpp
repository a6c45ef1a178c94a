// Above 250 lines: the edits, previews and comparisons of one model share its history.
#include "frangia/service/internal/surface_model.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <numeric>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/editor/edit_preview.h"
#include "frangia/editor/edit_script.h"
#include "frangia/features/feature_points.h"
#include "frangia/features/fit_points.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/boundary_loops.h"
#include "frangia/geometry/connected_components.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/service/internal/array_packer.h"

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

}  // namespace

SurfaceModel::SurfaceModel(const ProjectFolder& project, int revision, const Run& run)
    : project_(project), revision_(revision) {
  history_.emplace(read_mesh(project.surface(), run));
  std::error_code ignored;
  if (std::filesystem::exists(project.edits(), ignored)) {
    const EditScript script = read_edit_script(project.edits());
    MeshCounts before = counts_of(mesh());
    for (std::size_t i = 0; i < script.steps.size(); ++i) {
      run.report(static_cast<double>(i) / static_cast<double>(script.steps.size()));
      const Mesh mesh_before = mesh();
      history_->apply(script.steps[i], {.stop = run.stop});
      const MeshCounts after =
          equal_bytes(mesh_before.triangles, mesh().triangles) ? before : counts_of(mesh());
      changes_.push_back(change_of(mesh_before, before, history_->state(), after));
      before = after;
    }
    for (std::size_t i = script.done; i < script.steps.size(); ++i)
      history_->undo();
  }
  publish(run);
}

SurfacePtr SurfaceModel::apply(const EditStep& step, const Run& run) {
  const SurfacePtr before = snapshot_;
  history_->apply(step, run);
  shown_.resize(history_->done());  // those of steps that were undone are gone
  changes_.resize(history_->done());
  save();
  auto next = std::make_shared<SurfaceSnapshot>(*publish(run));
  changes_.back() =
      change_of(before->picture->mesh(), counts_of(*before), history_->state(), counts_of(*next));
  return show(std::move(next));
}

SurfacePtr SurfaceModel::select_component_of(std::size_t triangle, const Run& run) {
  require(triangle < mesh().triangles.size(), "the surface has no such triangle; pick another one");
  const auto number = connected_components(mesh()).component_of[triangle];
  return apply({"select-component", std::to_string(number)}, run);
}

SurfacePtr SurfaceModel::fit(const std::string& kind, const Run& run) {
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
  return show(std::move(next));
}

SurfacePtr SurfaceModel::preview(const EditStep& step, const Run& run) {
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
  shown->revision = ++previews_;
  shown->arrays = std::make_shared<const std::string>(packer.pack());
  auto next = std::make_shared<SurfaceSnapshot>(*snapshot_);
  next->preview = std::move(shown);
  return show(std::move(next));
}

SurfacePtr SurfaceModel::drop_preview() {
  auto next = std::make_shared<SurfaceSnapshot>(*snapshot_);
  next->preview.reset();
  return show(std::move(next));
}

SurfacePtr SurfaceModel::compare(const std::filesystem::path& reference,
                                 const std::string& name,
                                 const CompareOptions& options,
                                 const Run& run) {
  auto shown = std::make_shared<ShownComparison>();
  shown->found = compare_surface(mesh(), reference, options, run);
  shown->revision = ++comparisons_;
  shown->reference = name;
  shown->best_fit = options.best_fit;
  shown->start = options.start;
  auto next = std::make_shared<SurfaceSnapshot>(*snapshot_);
  next->comparison = std::move(shown);
  return show(std::move(next));
}

SurfacePtr SurfaceModel::undo(const Run& run) {
  require(history_->undo(), "there is no step to undo");
  save();
  return publish(run);
}

SurfacePtr SurfaceModel::redo(const Run& run) {
  require(history_->redo(), "there is no step to redo");
  save();
  return publish(run);
}

SurfacePtr SurfaceModel::publish(const Run& run) {
  const EditState& state = history_->state();
  const std::size_t done = history_->done();
  shown_.resize(history_->steps().size() + 1);
  ++revision_;
  auto next = std::make_shared<SurfaceSnapshot>();
  if (shown_[done]) {  // undone or done again: the picture is known
    *next = *shown_[done];
  } else if (snapshot_ && same_picture(snapshot_->picture->mesh(), state.mesh)) {
    *next = *snapshot_;
  } else {
    next->mesh_revision = revision_;
    describe(state.mesh, *next, run);
  }
  next->preview.reset();
  if (shown_[done] && *next->selection == state.selection) return show(std::move(next));
  next->selected = count_selected(state.selection);
  next->selection = std::make_shared<const Selection>(state.selection);
  next->selection_revision = revision_;
  return show(std::move(next));
}

SurfacePtr SurfaceModel::refine(const Run& run) {
  if (!snapshot_->picture->is_coarse()) return nullptr;
  auto next = std::make_shared<SurfaceSnapshot>(*snapshot_);
  next->picture = snapshot_->picture->refined(run);
  return show(std::move(next));
}

SurfacePtr SurfaceModel::show(std::shared_ptr<SurfaceSnapshot> next) {
  next->steps = history_->steps();
  next->done = history_->done();
  next->changes = changes_;
  snapshot_ = std::move(next);
  shown_[history_->done()] = snapshot_;
  forget_far_pictures();
  return snapshot_;
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

void SurfaceModel::save() const {
  write_edit_script(project_.edits(), {history_->steps(), history_->done()});
}

}  // namespace frangia
