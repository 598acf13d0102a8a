#include "spume/io/film_frame.hpp"

#include <array>
#include <cmath>
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

namespace {

/// Points of a frame by dof and by image: those of dofs as they lie in the box, and copies where a film or
/// border goes on beyond it.
class PointsByImage {
 public:
  PointsByImage(const Domain& domain, std::vector<Vec3>& point, std::vector<double>& value)
      : domain_(domain), point_(point), value_(value) {}

  /// Number of the point of a dof that lies at x, an image of it.
  int at(int dof, const Vec3& x) {
    const Vec3 base = point_[dof];
    std::array<int, 4> key{dof, 0, 0, 0};
    for (int d = 0; d < 3; ++d)
      if (domain_.periodic[d]) key[d + 1] = static_cast<int>(std::lround((x[d] - base[d]) / domain_.size[d]));
    if (key == std::array<int, 4>{dof, 0, 0, 0}) return dof;
    const auto [known, is_new] = copy_.try_emplace(key, static_cast<int>(point_.size()));
    if (is_new) {
      point_.push_back(x);
      value_.push_back(value_[dof]);
    }
    return known->second;
  }

 private:
  Domain domain_;
  std::vector<Vec3>& point_;
  std::vector<double>& value_;
  std::map<std::array<int, 4>, int> copy_;
};

/// Every triangle with its first corner in the box.
void add_films(const mesh::FilmMesh& films, const mesh::Topology& topology, state::FilmFrame& frame) {
  for (const auto& dof : topology.film_dof)
    frame.film_point.push_back(films.domain.inside(films.position[dof.vertex]));
  PointsByImage points(films.domain, frame.film_point, frame.half_thickness);
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto corner = films.corners(t);
    const Vec3 shift = films.domain.inside(corner[0]) - corner[0];
    std::array<int, 3> point;
    for (int c = 0; c < 3; ++c) point[c] = points.at(topology.corner_dof[t][c], corner[c] + shift);
    frame.triangle.push_back(
        {point, topology.triangle_lamella[t], films.triangle[t].phase_a, films.triangle[t].phase_b});
  }
}

/// Every border in one piece that starts in the box.
void add_borders(const mesh::FilmMesh& films, const mesh::Topology& topology, state::FilmFrame& frame) {
  std::map<std::pair<int, int>, int> dof_at;  // of (border, vertex)
  for (std::size_t d = 0; d < topology.border_dof.size(); ++d) {
    const auto& dof = topology.border_dof[d];
    frame.border_point.push_back(films.domain.inside(films.position[dof.vertex]));
    dof_at[{dof.border, dof.vertex}] = static_cast<int>(d);
  }
  PointsByImage points(films.domain, frame.border_point, frame.border_area);
  for (int b = 0; b < topology.n_borders(); ++b) {
    auto& line = frame.border_line.emplace_back();
    for (int v : topology.border[b].vertices) {
      const int dof = dof_at.at({b, v});
      const Vec3 here = frame.border_point[dof];
      line.push_back(
          points.at(dof, line.empty() ? here : films.domain.near(here, frame.border_point[line.back()])));
    }
  }
}

}  // namespace

state::FilmFrame film_frame(const mesh::FilmMesh& films, const mesh::Topology& topology,
                            const state::FilmLiquid& liquid, double time) {
  state::FilmFrame frame;
  frame.time = time;
  frame.half_thickness = half_thickness(films, topology, liquid);
  frame.border_area = border_area(films, topology, liquid);
  add_films(films, topology, frame);
  add_borders(films, topology, frame);
  return frame;
}

}  // namespace spume::io
