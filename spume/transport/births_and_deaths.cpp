#include "spume/transport/births_and_deaths.hpp"

#include <algorithm>
#include <vector>

#include "spume/transport/deposit.hpp"
#include "spume/transport/donors.hpp"

namespace spume::transport {

namespace {

/// A kind of piece (lamellae, or borders) of the new mesh.
struct Pieces {
  std::span<const int> group;  ///< per piece; −1: born
  std::span<const int> piece_of_dof;
  const Grouping& dofs;
  std::span<const double> measure;  ///< lumped area [m²] or length [m] per dof
  const PointBins& bins;
  double radius;  ///< of the neighbours that lend [m]
};

/// Fills one born piece evenly to the mean of the linked pieces around it. Gives what was moved [m³].
double fill_piece(const Pieces& pieces, int piece, std::span<const Vec3> points, std::span<double> volume) {
  const std::span<const int> own = pieces.dofs[piece];
  const Donors donors = find_donors(pieces.bins, points, pieces.radius, 4, Falloff::Square,
                                    [&](int dof) { return pieces.group[pieces.piece_of_dof[dof]] >= 0; });
  double has = 0, measure = 0;
  for (int d : own) {
    has += volume[d];
    measure += pieces.measure[d];
  }
  if (!(measure > 0)) return 0;
  const double lent = donors.sum(volume), lent_measure = donors.sum(pieces.measure);
  const double wanted = lent_measure > 0 ? measure * (lent / lent_measure) : 0;
  const double fraction = lent > 0 ? std::min(0.5, std::max(0.0, wanted - has) / lent) : 0;
  donors.take(fraction, volume);
  for (int d : own) volume[d] = (has + fraction * lent) * (pieces.measure[d] / measure);
  return fraction * lent;
}

/// The first border of a foam has no other border to borrow from: it takes a tenth of the liquid of the film
/// dofs along it.
double draw_from_films(const LiquidMesh& mesh, int border, NewLiquid liquid) {
  constexpr double fraction = 0.1;
  std::vector<int> dof_at(mesh.films.position.size(), -1);
  for (int d : mesh.dofs_of_border[border]) dof_at[mesh.topology.border_dof[d].vertex] = d;
  double drawn = 0;
  for (std::size_t f = 0; f < mesh.topology.film_dof.size(); ++f) {
    const int d = dof_at[mesh.topology.film_dof[f].vertex];
    if (d < 0) continue;
    const double share = fraction * liquid.film[f];
    liquid.film[f] -= share;
    liquid.border[d] += share;
    drawn += share;
  }
  return drawn;
}

}  // namespace

void give_away_gone(const LiquidMesh& from, std::span<const double> old_film,
                    std::span<const double> old_border, const Links& film_links, const Links& border_links,
                    const LiquidMesh& to, double h, const TransportParameters& parameters, NewLiquid liquid,
                    TransferReport& report) {
  const auto give = [&](const Vec3& x, double amount) {
    if (amount <= 0) return;
    if (!give_to_borders(to, x, amount, parameters.border_radius * h, h, liquid.border))
      give_to_films(to, x, amount, parameters.deposit_radius * h, h, liquid.film);
    report.from_gone += amount;
  };
  for (int group : film_links.group_of_old) report.n_gone_lamellae += group < 0;
  for (int group : border_links.group_of_old) report.n_gone_borders += group < 0;
  for (std::size_t d = 0; d < old_film.size(); ++d)
    if (film_links.group_of_old[from.lamella_of_dof[d]] < 0)
      give(from.film_position(static_cast<int>(d)), old_film[d]);
  for (std::size_t d = 0; d < old_border.size(); ++d)
    if (border_links.group_of_old[from.border_of_dof[d]] < 0)
      give(from.border_position(static_cast<int>(d)), old_border[d]);
}

void fill_born(const Links& film_links, const Links& border_links, const LiquidMesh& to, double h,
               const TransportParameters& parameters, NewLiquid liquid, TransferReport& report) {
  std::vector<Vec3> points;
  const Pieces lamellae{
      film_links.group_of_new,    to.lamella_of_dof, to.dofs_of_lamella, to.dof_area, to.film_bins,
      parameters.donor_radius * h};
  for (int l = 0; l < to.topology.n_lamellae(); ++l) {
    if (film_links.group_of_new[l] >= 0) continue;
    ++report.n_born_lamellae;
    points.clear();
    for (int d : to.dofs_of_lamella[l]) points.push_back(to.film_position(d));
    report.to_born += fill_piece(lamellae, l, points, liquid.film);
  }
  const Pieces borders{
      border_links.group_of_new,   to.border_of_dof, to.dofs_of_border, to.dof_length, to.border_bins,
      parameters.border_radius * h};
  for (int b = 0; b < to.topology.n_borders(); ++b) {
    if (border_links.group_of_new[b] >= 0) continue;
    ++report.n_born_borders;
    points.clear();
    for (int d : to.dofs_of_border[b]) points.push_back(to.border_position(d));
    const double received = fill_piece(borders, b, points, liquid.border);
    report.to_born += received > 0 ? received : draw_from_films(to, b, liquid);
  }
}

}  // namespace spume::transport
