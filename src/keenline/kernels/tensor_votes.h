#pragma once

#include "keenline/cloud.h"
#include "keenline/kernels/symmetric3.h"

namespace keenline::kernels {

// What a token at the origin says of the surface at another place, as a tensor n nᵀ of normals: the votes of
// Guy and Medioni 1997, "Inference of Surfaces, 3D Curves, and Junctions from Sparse, Noisy, 3D Data".
// `offset` goes from the voter to the receiver, in units of the voting scale sigma; it is not 0. Every vote
// is symmetric and has no negative eigenvalue, and a voter and its mirror image say the same.

/// Adds the vote of a piece of surface with this unit normal. It is the normal of the circle that touches the
/// piece and passes through the receiver; it fades with arc length s and curvature k as exp(-s² - c k²), and
/// beyond 45 degrees off the tangent plane there is none. `curvature_weight` is c, in sigma⁴.
void add_stick_vote(Symmetric3& tensor, const Point& normal, const Point& offset, double curvature_weight,
                    double weight = 1);

/// Adds the vote of a bare point: three times the mean over all normals of stick votes that fade as exp(-l²)
/// cos² of the angle off the tangent plane, l the distance, in closed form (Wu et al. 2012, "A Closed-Form
/// Solution to Tensor Voting").
void add_ball_vote(Symmetric3& tensor, const Point& offset, double weight = 1);

/// How much a tensor says of a surface, a curve and a junction, as shares of its largest eigenvalue that add
/// up to 1: (l1 - l2) / l1, (l2 - l3) / l1 and l3 / l1. All 0 where nobody voted.
struct Saliency {
  double surface = 0;
  double curve = 0;
  double junction = 0;
};

[[nodiscard]] Saliency saliency_of(const Eigen3& tensor);

}  // namespace keenline::kernels
