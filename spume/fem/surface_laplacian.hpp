#pragma once

#include <array>
#include <span>
#include <vector>

#include "spume/base/domain.hpp"
#include "spume/base/vec3.hpp"

namespace spume::fem {

/// Linear finite elements on a piece of triangulated surface: lumped mass m and cotangent stiffness K, row by
/// row and without the diagonal, K_ii = −Σ_j K_ij. Kf approximates −m Δ_s f weakly: summed with smooth
/// weights; at a single vertex only where six like triangles meet. The natural boundary condition is ∂f/∂ν =
/// 0.
struct SurfaceLaplacian {
  std::vector<double> mass;  ///< m_i: a third of the triangles at i [m²]
  std::vector<int> offset;   ///< neighbours of i: neighbour[offset[i] … offset[i+1]), increasing
  std::vector<int> neighbour;
  std::vector<double> stiffness;  ///< K_ij of those neighbours, without unit

  int size() const { return static_cast<int>(mass.size()); }
};

/// Assembles m and K for vertices at `position` [m] and triangles that index into them. K is exactly
/// symmetric. In a periodic domain a triangle has the images of its corners that are nearest to each other,
/// so that the surface may go all the way around. Throws NumericalError, with the place, where a triangle has
/// no area or a vertex no triangle.
SurfaceLaplacian assemble_surface_laplacian(std::span<const Vec3> position,
                                            std::span<const std::array<int, 3>> triangle,
                                            const Domain& domain = {});

/// Neighbours of the neighbours of a node, itself included, increasing: the rows of its column in K m⁻¹ K.
std::vector<int> second_ring(const SurfaceLaplacian& surface, int node);

}  // namespace spume::fem
