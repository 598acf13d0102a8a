#include "spume/io/film_frame.hpp"

#include <map>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::io {

std::vector<double> half_thickness(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                   const state::FilmLiquid& liquid) {
  expects(liquid.lamella_volume.size() == topology.film_dof.size(), "one liquid volume for each film dof");
  std::vector<double> eta = mesh::film_dof_areas(films, topology);
  for (std::size_t d = 0; d < eta.size(); ++d) eta[d] = liquid.lamella_volume[d] / (2 * eta[d]);
  return eta;
}

std::vector<double> border_area(const mesh::FilmMesh& films, const mesh::Topology& topology,
                                const state::FilmLiquid& liquid) {
  expects(liquid.border_volume.size() == topology.border_dof.size(), "one liquid volume for each border dof");
  std::vector<double> lambda = mesh::border_dof_lengths(films, topology);
  for (std::size_t d = 0; d < lambda.size(); ++d) lambda[d] = liquid.border_volume[d] / lambda[d];
  return lambda;
}

state::FilmFrame film_frame(const mesh::FilmMesh& films, const mesh::Topology& topology,
                            const state::FilmLiquid& liquid, double time) {
  state::FilmFrame frame;
  frame.time = time;
  frame.half_thickness = half_thickness(films, topology, liquid);
  frame.border_area = border_area(films, topology, liquid);
  for (const auto& dof : topology.film_dof) frame.film_point.push_back(films.position[dof.vertex]);
  for (int t = 0; t < films.n_triangles(); ++t)
    frame.triangle.push_back({topology.corner_dof[t], topology.triangle_lamella[t], films.triangle[t].phase_a,
                              films.triangle[t].phase_b});

  std::map<std::pair<int, int>, int> dof_at;  // of (border, vertex)
  for (std::size_t d = 0; d < topology.border_dof.size(); ++d) {
    const auto& dof = topology.border_dof[d];
    frame.border_point.push_back(films.position[dof.vertex]);
    dof_at[{dof.border, dof.vertex}] = static_cast<int>(d);
  }
  for (int b = 0; b < topology.n_borders(); ++b) {
    auto& line = frame.border_line.emplace_back();
    for (int v : topology.border[b].vertices) line.push_back(dof_at.at({b, v}));
  }
  return frame;
}

}  // namespace spume::io
