#pragma once

#include <span>
#include <vector>

#include "spume/transport/births_and_deaths.hpp"
#include "spume/transport/links.hpp"
#include "spume/transport/liquid_mesh.hpp"
#include "spume/transport/transfer.hpp"

namespace spume::transport {

/// A film about to vanish would end with all its liquid on no area. A linked lamella below `small_area` whose
/// mean half-thickness exceeds `cap` × the mean of other films within donor_radius + √area gives the excess
/// to the borders on its rim, uniformly by length.
void cap_small_films(const Links& film_links, const LiquidMesh& mesh, double h,
                     const TransportParameters& parameters, NewLiquid liquid, TransferReport& report);

/// Which lamellae of the new mesh are young: without a link; smaller than `small_area`; or carrying on a
/// young lamella (the largest of their group) and grown by more than 2 % since the last transfer.
std::vector<char> young_lamellae(const Links& film_links, const LiquidMesh& to,
                                 std::span<const char> old_is_young,
                                 std::span<const double> old_area_at_transfer, double h,
                                 const TransportParameters& parameters);

/// Fills the dofs of young lamellae up to `floor` × the mean thickness of other films within `donor_radius`:
/// first from the borders on their rims (what these have above half the mean cross-section), then from those
/// films (at most half). Borders that grow (on the rim of a young lamella, or shorter than √small_area) are
/// filled likewise from borders within `border_radius`, from what those have above half of their mean. Gives
/// what was moved [m³].
double fill_young(const LiquidMesh& mesh, std::span<const char> is_young, double h,
                  const TransportParameters& parameters, NewLiquid liquid);

}  // namespace spume::transport
