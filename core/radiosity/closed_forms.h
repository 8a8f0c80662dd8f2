// Form factors without occlusion in closed form, in double precision.
//                                                  [Lang, eq. 10.80-10.84, 10.97, 10.98, corrected; Howell et al. 2010]
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace etendue::radiosity {

using DVec3 = glm::dvec3;
// The corners of a planar polygon, counter-clockwise as seen from its front side.
using Polygon = std::vector<DVec3>;

// Between two equal parallel rectangles of sides a and b, opposite each other at distance c.
double parallel_rectangles(double a, double b, double c);
// From a rectangle to a perpendicular one that shares an edge; x is the depth of the emitting and y the height of the
// receiving rectangle over the length of the edge.
double perpendicular_rectangles(double x, double y);
// Between coaxial parallel disks of radii r1 (emitting) and r2 at a distance.
double coaxial_disks(double r1, double r2, double distance);
// From a point to a parallel disk of radius r at a distance; the axis of the disk passes the point at `offset`.
double point_to_disk(double r, double distance, double offset = 0);
// From a point to a parallel rectangle of sides u and v at distance w, with a corner above the point.
double point_to_rectangle(double u, double v, double w);

// The part of a polygon in the half-space in front of a plane through `point`.
Polygon clipped(const Polygon& polygon, const DVec3& point, const DVec3& normal);
// From a point with a unit normal to a polygon that faces it; the part behind the point does not count. [Lambert 1760]
double point_to_polygon(const DVec3& point, const DVec3& normal, const Polygon& polygon);

// The area times the form factor of two polygons, by contour integration (Stokes):
//
//    A_i F_ij = 1 / (2 pi)  sum over edge pairs  (d_i . d_j)  integral of ln r
//
// The inner integral has a closed form; the outer one is integrated by Gauss-Legendre quadrature after a substitution
// that removes the singularities at the ends of an edge, with `nodes` nodes (at most kMostNodes). Equal edges have a
// closed form. The polygons must lie in front of each other.
inline constexpr int kMostNodes = 32;
double contour_exchange(const Polygon& i, const Polygon& j, int nodes = 16);

}  // namespace etendue::radiosity
