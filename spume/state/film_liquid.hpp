#pragma once

#include <vector>

namespace spume::state {

/// The liquid of the films as volumes [m³], one per film dof (vertex, lamella) and one per border dof
/// (vertex, border) of mesh::Topology of the film mesh. Half-thickness η = volume/(2 lumped area),
/// cross-section λ = volume/lumped length; so nothing changes hands while films move with the gas, and
/// total() is the ledger 2Σ∫η dA + Σ∫λ dℓ.
struct FilmLiquid {
  std::vector<double> lamella_volume;            ///< per film dof [m³]
  std::vector<double> border_volume;             ///< per border dof [m³]
  std::vector<char> lamella_is_young;            ///< per lamella: born by a T1 and still growing
  std::vector<double> lamella_area_at_transfer;  ///< per lamella [m²]
  double sprayed = 0;                            ///< lost to the ambient gas by ruptures with `spray` [m³]

  double in_lamellae() const;
  double in_borders() const;
  double total() const { return in_lamellae() + in_borders(); }
};

}  // namespace spume::state
