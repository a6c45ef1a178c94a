#include "edit_findings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "fixed_text.h"
#include "json_number.h"
#include "print_text.h"

namespace frangia {
namespace {

constexpr std::size_t kShown = 20;

/// Indices of the items in descending order of size.
template <typename Item>
std::vector<std::size_t> by_size(const std::vector<Item>& items) {
  std::vector<std::size_t> order(items.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return items[a].size_mm > items[b].size_mm;
  });
  return order;
}

void print_remainder(std::size_t count) {
  if (count > kShown) print_text("  {} more, all smaller (--json lists them)\n", count - kShown);
}

void print_components(const std::vector<MeshComponent>& components) {
  if (components.size() < 2) return;
  print_text("\n  component  size mm     area mm2  triangles\n");
  const auto order = by_size(components);
  for (std::size_t i = 0; i < std::min(kShown, order.size()); ++i) {
    const MeshComponent& component = components[order[i]];
    print_text("  {:>9} {:>8.2f} {:>12.2f} {:>10}\n",
               order[i],
               component.size_mm,
               component.area_mm2,
               component.triangles);
  }
  print_remainder(components.size());
}

void print_holes(const std::vector<BoundaryLoop>& holes) {
  if (holes.empty()) return;
  print_text("\n  hole  size mm    length mm      edges\n");
  const auto order = by_size(holes);
  for (std::size_t i = 0; i < std::min(kShown, order.size()); ++i) {
    const BoundaryLoop& hole = holes[order[i]];
    print_text("  {:>4} {:>8.2f} {:>12.2f} {:>10}\n",
               order[i],
               hole.size_mm,
               hole.length_mm,
               hole.edges.size());
  }
  print_remainder(holes.size());
}

void print_line(const char* what, const std::string& value) {
  print_text("{:<20} {}\n", what, value);
}

}  // namespace

nlohmann::ordered_json findings_json(const MeshFindings& found) {
  nlohmann::ordered_json json;
  json["vertices"] = found.vertices;
  json["triangles"] = found.triangles;
  json["components"] = nlohmann::ordered_json::array();
  for (const MeshComponent& component : found.components) {
    json["components"].push_back({{"triangles", component.triangles},
                                  {"size_mm", component.size_mm},
                                  {"area_mm2", component.area_mm2}});
  }
  json["holes"] = nlohmann::ordered_json::array();
  for (const BoundaryLoop& loop : found.holes) {
    json["holes"].push_back(
        {{"edges", loop.edges.size()}, {"size_mm", loop.size_mm}, {"length_mm", loop.length_mm}});
  }
  json["non_manifold_edges"] = found.non_manifold_edges;
  json["degenerate_triangles"] = found.degenerate_triangles;
  if (found.self_intersections) json["self_intersections"] = *found.self_intersections;
  json["closed"] = found.closed;
  json["measured"] = found.marks[0];
  json["displaced"] = found.marks[1];
  json["synthesized"] = found.marks[2];
  json["area_mm2"] = found.area_mm2;
  json["volume_mm3"] = number_or_null(found.volume_mm3);
  if (!found.box_mm.isEmpty()) {
    const Eigen::Vector3d& low = found.box_mm.min();
    const Eigen::Vector3d& high = found.box_mm.max();
    json["min_mm"] = {low.x(), low.y(), low.z()};
    json["max_mm"] = {high.x(), high.y(), high.z()};
  }
  return json;
}

void print_findings(const MeshFindings& found) {
  const auto point_text = [](const Eigen::Vector3d& p) {
    return fmt::format(
        "{} {} {}", fixed_text(p.x(), 3), fixed_text(p.y(), 3), fixed_text(p.z(), 3));
  };
  print_line("triangles", fmt::format("{}", found.triangles));
  print_line("vertices", fmt::format("{}", found.vertices));
  print_line("marks",
             fmt::format("{} measured, {} displaced, {} synthesized",
                         found.marks[0],
                         found.marks[1],
                         found.marks[2]));
  if (!found.box_mm.isEmpty()) {
    print_line("bounds mm",
               point_text(found.box_mm.min()) + "  to  " + point_text(found.box_mm.max()));
  }
  print_line("area mm2", fmt::format("{:.3f}", found.area_mm2));
  print_line("volume mm3",
             std::isfinite(found.volume_mm3) ? fixed_text(found.volume_mm3, 3)
                                             : "none: the mesh is not closed");
  print_line("non-manifold edges",
             found.non_manifold_edges == 0
                 ? "0"
                 : fmt::format("{}; --orient and --make-manifold repair them, and show the holes "
                               "at them",
                               found.non_manifold_edges));
  print_line("degenerate", fmt::format("{}", found.degenerate_triangles));
  print_line("intersecting pairs",
             found.self_intersections ? fmt::format("{}", *found.self_intersections)
                                      : "unknown: this build has no CGAL");
  print_line("components", fmt::format("{}", found.components.size()));
  print_line("holes", fmt::format("{}", found.holes.size()));
  print_components(found.components);
  print_holes(found.holes);
}

}  // namespace frangia
