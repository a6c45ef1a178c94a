#pragma once

#include <cstdint>

#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopoDS_Shape.hxx>

namespace frangia {

/// Checks of what comes from a file or from the second process, before anything is computed of it:
/// OpenCASCADE itself neither checks indices nor ends on numbers that are none. Each error is
/// without the name of the file.

/// Checks that vertices, curves and surfaces state finite numbers, and that edges have two ends.
///
/// @errors   Error(Input) that names the face or edge by its number
void check_geometry(const TopoDS_Shape& shape);

/// Checks that the triangles of a face name nodes that it has, and that these are finite.
///
/// @param face  its number, from 1
/// @errors   Error(Input)
void check_triangles(const Poly_Triangulation& triangles, std::uint32_t face);

/// Checks that an edge names nodes that its face has.
///
/// @errors   Error(Input)
void check_polygon(const Poly_PolygonOnTriangulation& polygon,
                   const Poly_Triangulation& triangles,
                   std::uint32_t face);

}  // namespace frangia
