#pragma once

#include <span>
#include <vector>

#include "spume/transport/links.hpp"
#include "spume/transport/liquid_mesh.hpp"
#include "spume/transport/transfer.hpp"

namespace spume::transport {

struct BorderTransfer {
  std::vector<double> volume;  ///< per new border dof [m³]; 0 in borders without a link
  Links links;                 ///< of borders
};

/// Interpolates the cross-section λ from the old borders to the dofs of the new ones (cubic spline in arc
/// length) and rescales it so that every group of linked borders holds what it held. Borders are linked to
/// old ones of the same three phases within 1.5 × `reach`; one without such a link, to old borders there that
/// share two of its phases and run parallel to it.
BorderTransfer transfer_borders(const LiquidMesh& from, std::span<const double> old_volume,
                                const LiquidMesh& to, double h, const TransportParameters& parameters);

}  // namespace spume::transport
