#pragma once

#include <span>
#include <vector>

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"

namespace spume::rupture {

/// The liquid of torn lamellae on its way (paper, Sec. 3.4 step i).
struct TornLiquid {
  std::vector<double> on_edge;      ///< per border edge: received from torn lamellae [m³]
  double to_borders = 0;            ///< sum of these [m³]
  std::vector<int> without_border;  ///< film dofs of torn lamellae that no border bounds (closed films)
};

/// Gives the liquid of each torn lamella to the border edges on its rim, uniformly by length: λ grows by
/// δ = 2∫η dA / Σ ∫dℓ. `is_torn` is per lamella, `lamella_volume` per film dof [m³].
TornLiquid redistribute(const mesh::FilmMesh& films, const mesh::Topology& topology,
                        std::span<const char> is_torn, std::span<const double> lamella_volume);

/// Length of each border edge [m].
std::vector<double> border_edge_lengths(const mesh::FilmMesh& films, const mesh::Topology& topology);

}  // namespace spume::rupture
