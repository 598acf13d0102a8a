#include "spume/transport/transfer.hpp"

#include <algorithm>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/transport/births_and_deaths.hpp"
#include "spume/transport/border_transfer.hpp"
#include "spume/transport/film_transfer.hpp"
#include "spume/transport/ledger.hpp"
#include "spume/transport/liquid_mesh.hpp"
#include "spume/transport/small_films.hpp"

namespace spume::transport {

namespace {

void expect_sizes(const mesh::Topology& topology, const state::FilmLiquid& liquid) {
  expects(liquid.lamella_volume.size() == topology.film_dof.size(), "one liquid volume per film dof");
  expects(liquid.border_volume.size() == topology.border_dof.size(), "one liquid volume per border dof");
  expects(liquid.lamella_is_young.size() == topology.lamella.size(), "one young flag per lamella");
  expects(liquid.lamella_area_at_transfer.size() == topology.lamella.size(), "one area per lamella");
}

}  // namespace

state::FilmLiquid uniform_liquid(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                 double half_thickness, double border_area) {
  state::FilmLiquid liquid;
  liquid.lamella_volume = mesh::film_dof_areas(films, topology);
  for (double& volume : liquid.lamella_volume) volume *= 2 * half_thickness;
  liquid.border_volume = mesh::border_dof_lengths(films, topology);
  for (double& volume : liquid.border_volume) volume *= border_area;
  liquid.lamella_is_young.assign(topology.lamella.size(), 0);
  liquid.lamella_area_at_transfer = mesh::lamella_areas(films, topology);
  return liquid;
}

state::FilmLiquid transfer(const parallel::Communicator& ranks, const mesh::FilmMesh& from,
                           const mesh::Topology& from_topology, const state::FilmLiquid& liquid,
                           const mesh::FilmMesh& to, const mesh::Topology& to_topology, double h,
                           const TransportParameters& parameters, TransferReport& report) {
  expect_sizes(from_topology, liquid);
  expects(from_topology.corner_dof.size() == from.triangle.size() &&
              to_topology.corner_dof.size() == to.triangle.size(),
          "topologies are those of the films");
  const LiquidMesh old_mesh = measure_liquid_mesh(from, from_topology, h);
  const LiquidMesh new_mesh = measure_liquid_mesh(to, to_topology, h);
  FilmTransfer films =
      transfer_films(ranks, old_mesh, liquid.lamella_volume, new_mesh, h, parameters, report);
  BorderTransfer borders = transfer_borders(old_mesh, liquid.border_volume, new_mesh, h, parameters);

  const NewLiquid volumes{films.volume, borders.volume};
  give_away_gone(old_mesh, liquid.lamella_volume, liquid.border_volume, films.links, borders.links, new_mesh,
                 h, parameters, volumes, report);
  cap_small_films(films.links, new_mesh, h, parameters, volumes, report);
  fill_born(films.links, borders.links, new_mesh, h, parameters, volumes, report);

  state::FilmLiquid result;
  result.lamella_is_young = young_lamellae(films.links, new_mesh, liquid.lamella_is_young,
                                           liquid.lamella_area_at_transfer, h, parameters);
  report.floored += fill_young(new_mesh, result.lamella_is_young, h, parameters, volumes);
  result.lamella_volume = std::move(films.volume);
  result.border_volume = std::move(borders.volume);
  result.lamella_area_at_transfer = new_mesh.lamella_area;
  result.sprayed = liquid.sprayed;
  close_ledger(liquid.total(), result);
  return result;
}

double fill_young_films(const mesh::FilmMesh& films, const mesh::Topology& topology,
                        state::FilmLiquid& liquid, double h, const TransportParameters& parameters) {
  expect_sizes(topology, liquid);
  const auto& young = liquid.lamella_is_young;
  if (std::find(young.begin(), young.end(), 1) == young.end()) return 0;
  const double before = liquid.total();
  const LiquidMesh mesh = measure_liquid_mesh(films, topology, h);
  const double moved = fill_young(mesh, young, h, parameters, {liquid.lamella_volume, liquid.border_volume});
  close_ledger(before, liquid);
  return moved;
}

}  // namespace spume::transport
