#pragma once

#include "engine/core/frames.h"

/// Closest points between simple things (C. Ericson, Real-Time Collision Detection, 2005, ch. 5).
/// All are defined for degenerate input (segments of no length, triangles of no area).
namespace pedicel::geometry {

/// The parameter t in [0, 1] of the point a + t (b - a) of segment a-b that is closest to p.
double closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b);

struct SegmentPair {
  double s = 0.0, t = 0.0;  ///< places on the first and the second segment, in [0, 1]
  Vec3 first = Vec3::Zero(), second = Vec3::Zero();
  double distance = 0.0;
};

/// The closest points of the segments a0-a1 and b0-b1; one such pair where the segments run beside
/// each other.
SegmentPair closest_on_segments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);

/// The part of a triangle that holds the closest point: edge_ab lies between vertices a and b.
enum class TriangleFeature { face, edge_ab, edge_bc, edge_ca, vertex_a, vertex_b, vertex_c };

struct TrianglePoint {
  Vec3 point = Vec3::Zero();
  TriangleFeature feature = TriangleFeature::face;
};

/// The point of triangle a-b-c that is closest to p. A triangle with an angle at `a` within 1e-6 of
/// 0 or pi counts as its edges.
TrianglePoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace pedicel::geometry
