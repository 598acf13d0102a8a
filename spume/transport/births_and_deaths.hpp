#pragma once

#include <span>

#include "spume/transport/links.hpp"
#include "spume/transport/liquid_mesh.hpp"
#include "spume/transport/transfer.hpp"

namespace spume::transport {

/// What the transport law leaves open: lamellae and borders that exist in one of two meshes only (a T1, or a
/// bubble lost). All volumes are of the new mesh [m³]; liquid only changes place.
struct NewLiquid {
  std::span<double> film, border;
};

/// Lamellae and borders of the old mesh without a link: their liquid goes to border dofs within
/// `border_radius`, or, where there are none, to the films around.
void give_away_gone(const LiquidMesh& from, std::span<const double> old_film,
                    std::span<const double> old_border, const Links& film_links, const Links& border_links,
                    const LiquidMesh& to, double h, const TransportParameters& parameters, NewLiquid liquid,
                    TransferReport& report);

/// Lamellae of the new mesh without a link: filled to the mean half-thickness of other films within
/// `donor_radius`, taken from those (at most half of each). Borders likewise with the mean cross-section
/// within `border_radius`.
void fill_born(const Links& film_links, const Links& border_links, const LiquidMesh& to, double h,
               const TransportParameters& parameters, NewLiquid liquid, TransferReport& report);

}  // namespace spume::transport
