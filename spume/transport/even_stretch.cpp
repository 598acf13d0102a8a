#include "spume/transport/even_stretch.hpp"

#include <cstddef>
#include <span>
#include <vector>

#include "spume/base/contract.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/transport/ledger.hpp"

namespace spume::transport {

namespace {

/// A kind of piece (lamellae, or borders), and the lumped area [m²] or length [m] of each of its dofs before
/// and after the motion.
struct StretchedPieces {
  std::vector<int> piece_of_dof;
  std::vector<double> before, after;
};

/// Sum over the dofs of each piece.
std::vector<double> sums(int n_pieces, std::span<const int> piece_of_dof, std::span<const double> values) {
  std::vector<double> sum(n_pieces, 0.0);
  for (std::size_t d = 0; d < values.size(); ++d) sum[piece_of_dof[d]] += values[d];
  return sum;
}

void stretch(int n_pieces, const StretchedPieces& pieces, std::vector<double>& volume) {
  const auto held = sums(n_pieces, pieces.piece_of_dof, volume),
             measure = sums(n_pieces, pieces.piece_of_dof, pieces.before);
  std::vector<double> stretched(volume.size());
  for (std::size_t d = 0; d < volume.size(); ++d) {
    const int p = pieces.piece_of_dof[d];
    const double thickness = pieces.before[d] > 0 ? volume[d] / pieces.before[d]
                             : measure[p] > 0     ? held[p] / measure[p]
                                                  : 1;
    stretched[d] = thickness * pieces.after[d];
  }
  const auto holds = sums(n_pieces, pieces.piece_of_dof, stretched);
  for (std::size_t d = 0; d < volume.size(); ++d) {
    const int p = pieces.piece_of_dof[d];
    if (holds[p] > 0) volume[d] = stretched[d] * (held[p] / holds[p]);
  }
}

}  // namespace

void stretch_evenly(const mesh::FilmMesh& from, const mesh::FilmMesh& to, const mesh::Topology& topology,
                    state::FilmLiquid& liquid) {
  expects(liquid.lamella_volume.size() == topology.film_dof.size(), "one liquid volume per film dof");
  expects(liquid.border_volume.size() == topology.border_dof.size(), "one liquid volume per border dof");
  const double before = liquid.total();
  StretchedPieces lamellae{{}, mesh::film_dof_areas(from, topology), mesh::film_dof_areas(to, topology)};
  for (const auto& dof : topology.film_dof) lamellae.piece_of_dof.push_back(dof.lamella);
  stretch(topology.n_lamellae(), lamellae, liquid.lamella_volume);
  StretchedPieces borders{
      {}, mesh::border_dof_lengths(from, topology), mesh::border_dof_lengths(to, topology)};
  for (const auto& dof : topology.border_dof) borders.piece_of_dof.push_back(dof.border);
  stretch(topology.n_borders(), borders, liquid.border_volume);
  close_ledger(before, liquid);
}

}  // namespace spume::transport
