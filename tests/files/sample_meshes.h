#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/geometry/mesh.h"

namespace frangia::testing {

/// A wavy open sheet of side x side vertices and 2 (side - 1)^2 triangles, whose coordinates use
/// all digits of a float.
inline Mesh sheet(std::uint32_t side) {
  Mesh mesh;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const float u = static_cast<float>(x) / 7.0F;
      const float v = static_cast<float>(y) / 11.0F;
      mesh.vertices_mm.emplace_back(u - 1.0F, v, std::sin(u) * std::cos(v) / 3.0F);
    }
  }
  for (std::uint32_t i = 0; i + side < side * side; ++i) {
    if (i % side + 1 == side) continue;
    mesh.triangles.push_back({i, i + 1, i + side});
    mesh.triangles.push_back({i + 1, i + side + 1, i + side});
  }
  return mesh;
}

/// `sheet` with normals, sigma and views.
inline Mesh measured_sheet(std::uint32_t side) {
  Mesh mesh = sheet(side);
  mesh.normals = vertex_normals(mesh);
  for (const auto& vertex : mesh.vertices_mm) {
    mesh.sigma_mm.push_back(0.01F + std::abs(vertex.z()) / 100.0F);
    mesh.views.push_back(static_cast<std::uint16_t>(mesh.views.size() * 997));
  }
  return mesh;
}

/// `measured_sheet` whose triangles are displaced in every fifth place and synthesized in the next.
inline Mesh marked_sheet(std::uint32_t side) {
  Mesh mesh = measured_sheet(side);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    mesh.triangle_marks.push_back(i % 5 == 1   ? Mark::Displaced
                                  : i % 5 == 2 ? Mark::Synthesized
                                               : Mark::Measured);
  }
  return mesh;
}

inline void expect_same_surface(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.vertices_mm, b.vertices_mm);
  EXPECT_EQ(a.triangles, b.triangles);
}

/// The message of the Error that `work` throws; fails the test when it throws none.
template <typename Work>
std::string error_of(Work&& work) {
  try {
    static_cast<void>(work());
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no Error was thrown";
  return {};
}

}  // namespace frangia::testing
