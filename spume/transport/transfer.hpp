#pragma once

#include "spume/mesh/film_mesh.hpp"
#include "spume/mesh/topology.hpp"
#include "spume/parallel/communicator.hpp"
#include "spume/state/film_liquid.hpp"

namespace spume::transport {

/// Rules for lamellae and borders that are born or die between two meshes. What a T1 does to the liquid is
/// not determined by the transport law; these are choices that the user sees.
struct TransportParameters {
  double reach = 1.0;           ///< old and new pieces closer than this × h are the same film
  double deposit_radius = 1.5;  ///< of the liquid of a vanished film [h]
  double donor_radius = 2.0;    ///< neighbours that lend to a new film [h]
  double border_radius = 3.0;   ///< borders that take a vanished film's liquid or lend to a new border [h]
  double small_area = 10;       ///< films below this × h² are small: capped, and young
  double cap = 2.0;             ///< a small film keeps at most this × its neighbours' mean thickness
  double floor =
      0.5;  ///< a young film is filled up to this × the mean thickness (of its neighbours or of all)
};

struct TransferReport {
  double smallest_rescaling = 1, largest_rescaling = 1;  ///< of lamellae larger than small_area
  int n_born_lamellae = 0, n_gone_lamellae = 0, n_born_borders = 0, n_gone_borders = 0;
  double to_born = 0, from_gone = 0, capped = 0, floored = 0;  ///< [m³]
};

/// A uniform start: half-thickness η [m] of every lamella and cross-section λ [m²] of every border; no
/// lamella is young.
state::FilmLiquid uniform_liquid(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                 double half_thickness, double border_area);

/// Carries the liquid from one mesh to another of (nearly) the same surface (paper, Sec. 3.2.2, here without
/// particles); total() and `sprayed` are kept, total() to round-off; no volume becomes negative. `h` [m]
/// scales the reaches of the parameters. Phases of the two meshes are the same but for bubbles that split or
/// vanished: rupture comes before. The report's numbers add to those it has. Throws NumericalError when the
/// new mesh has no film to hold the liquid. Collective: the ranks, which all have both meshes, share the
/// work.
state::FilmLiquid transfer(const parallel::Communicator& ranks, const mesh::FilmMesh& from,
                           const mesh::Topology& from_topology, const state::FilmLiquid& liquid,
                           const mesh::FilmMesh& to, const mesh::Topology& to_topology, double h,
                           const TransportParameters& parameters, TransferReport& report);

/// Every step between reconstructions: fills young films (and, while there are any, growing borders) up to
/// the floor. total() is kept. Gives what was moved [m³].
double fill_young_films(const mesh::FilmMesh& films, const mesh::Topology& topology,
                        state::FilmLiquid& liquid, double h, const TransportParameters& parameters);

}  // namespace spume::transport
