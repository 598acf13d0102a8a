#pragma once

#include <span>
#include <vector>

#include "spume/transport/links.hpp"
#include "spume/transport/liquid_mesh.hpp"
#include "spume/transport/transfer.hpp"

namespace spume::transport {

struct FilmTransfer {
  std::vector<double> volume;  ///< per new film dof [m³]; 0 in lamellae without a link
  Links links;                 ///< of lamellae
};

/// Interpolates the half-thickness η from the old film to the dofs of the new one and rescales it so that
/// every group of linked lamellae holds what it held.
///
/// η is linear on the closest old triangle, plus Σ_edges w_i w_j (g_i − g_j)·(x_j − x_i)/2 with nodal
/// least-squares gradients g: exact for quadratic η where the gradients are. The correction removes nearly
/// all of the diffusion that linear interpolation makes each time. The sum stays within the extrema of the
/// triangles around the three corners: no overshoot, never negative.
///
/// A new lamella is linked to the old ones of its phase pair within `reach`; one without any such link, to
/// old films within `reach` that share one of its phases and lie parallel to it (a bubble that split or
/// vanished renames films). Collective.
FilmTransfer transfer_films(const parallel::Communicator& ranks, const LiquidMesh& from,
                            std::span<const double> old_volume, const LiquidMesh& to, double h,
                            const TransportParameters& parameters, TransferReport& report);

}  // namespace spume::transport
