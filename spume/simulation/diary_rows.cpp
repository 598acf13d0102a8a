#include "spume/simulation/diary_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spume/io/film_frame.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/mesh/phase_frames.hpp"

namespace spume::simulation {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Largest |V − V_target| / V_target of a bubble; not a number where a volume is not.
double max_volume_error(const state::Foam& foam) {
  const auto volume = mesh::phase_volumes(foam.films, foam.phases.count());
  double largest = 0;
  for (mesh::Phase p = 1; p < foam.phases.count(); ++p) {
    if (!foam.phases.is_bubble(p)) continue;
    const double error = std::abs(volume[p] / foam.phases.target_volume[p] - 1);
    if (std::isnan(error)) return error;
    largest = std::max(largest, error);
  }
  return largest;
}

std::vector<double> sum_by_lamella(const mesh::Topology& topology, const std::vector<double>& of_film_dof) {
  std::vector<double> sum(topology.lamella.size(), 0.0);
  for (std::size_t d = 0; d < of_film_dof.size(); ++d) sum[topology.film_dof[d].lamella] += of_film_dof[d];
  return sum;
}

}  // namespace

std::vector<double> min_half_thickness(const state::Foam& foam, const mesh::Topology& topology) {
  const auto area = mesh::film_dof_areas(foam.films, topology);
  const auto lamella_area = sum_by_lamella(topology, area);
  const auto n_dofs = sum_by_lamella(topology, std::vector<double>(area.size(), 1.0));
  std::vector<double> smallest(topology.lamella.size(), infinity);
  for (std::size_t d = 0; d < area.size(); ++d) {
    const int l = topology.film_dof[d].lamella;
    if (area[d] > 0.05 * lamella_area[l] / n_dofs[l])
      smallest[l] = std::min(smallest[l], foam.liquid.lamella_volume[d] / (2 * area[d]));
  }
  return smallest;
}

std::vector<double> mean_curvatures(const mesh::FilmMesh& films, const mesh::Topology& topology) {
  const auto descent = mesh::area_descent(films);
  const auto normal = mesh::film_dof_normals(films, topology);
  auto area = mesh::film_dof_areas(films, topology);
  std::vector<double> pull(area.size(), 0.0);
  for (std::size_t d = 0; d < area.size(); ++d) {
    const int v = topology.film_dof[d].vertex;
    if (topology.vertex_kind[v] == mesh::VertexKind::Film)
      pull[d] = dot(descent[v], normal[d]);
    else
      area[d] = 0;
  }
  auto curvature = sum_by_lamella(topology, pull);
  const auto inside = sum_by_lamella(topology, area);
  for (std::size_t l = 0; l < curvature.size(); ++l)
    curvature[l] = inside[l] > 0 ? curvature[l] / inside[l] : std::numeric_limits<double>::quiet_NaN();
  return curvature;
}

std::vector<PhaseShape> phase_shapes(const mesh::FilmMesh& films, int n_phases) {
  const mesh::PhaseFrames frames(films, n_phases);
  // ∫ x dV over the tetrahedra from the middle of the phase to its triangles; outward of phase_a, inward of
  // phase_b.
  std::vector<Vec3> moment(n_phases);
  std::vector<double> volume(n_phases, 0.0);
  for (int t = 0; t < films.n_triangles(); ++t)
    for (mesh::Phase p : {films.triangle[t].phase_a, films.triangle[t].phase_b}) {
      const Vec3 middle = frames.middle(p);
      const auto corner = frames.place(p, films.corners(t));
      const Vec3 a = corner[0] - middle, b = corner[1] - middle, c = corner[2] - middle;
      const double tetrahedron = (p == films.triangle[t].phase_a ? 1 : -1) * dot(a, cross(b, c)) / 6;
      volume[p] += tetrahedron;
      moment[p] += 0.25 * tetrahedron * (a + b + c);
    }
  std::vector<PhaseShape> shapes(n_phases);
  for (int p = 0; p < n_phases; ++p)
    shapes[p] = {films.domain.inside(frames.middle(p) + moment[p] / volume[p]),
                 frames.upper(p) - frames.lower(p)};
  return shapes;
}

Row history_row(const state::Foam& foam, const mesh::Topology& topology, const StepRecord& record,
                double initial_liquid) {
  double thinnest = record.min_half_thickness;
  if (thinnest <= 0) {
    const auto of_lamella = min_half_thickness(foam, topology);
    thinnest = of_lamella.empty() ? 0 : *std::min_element(of_lamella.begin(), of_lamella.end());
  }
  const double liquid = foam.liquid.total() + foam.liquid.sprayed;
  const double error = initial_liquid > 0 ? (liquid - initial_liquid) / initial_liquid : 0;
  return {record.step,
          std::string(name(record.stage)),
          foam.time,
          record.dt,
          mesh::film_area(foam.films),
          record.kinetic_energy,
          foam.liquid.in_lamellae(),
          foam.liquid.in_borders(),
          error,
          thinnest,
          foam.phases.n_bubbles(),
          topology.n_lamellae(),
          topology.n_borders(),
          topology.n_junctions(),
          record.max_speed,
          max_volume_error(foam),
          record.correction,
          record.limited_by};
}

std::vector<Row> bubble_rows(const state::Foam& foam, const mesh::Topology& topology,
                             const std::vector<double>& pressure) {
  const int n_phases = foam.phases.count();
  const auto volume = mesh::phase_volumes(foam.films, n_phases);
  const auto area = mesh::phase_areas(foam.films, n_phases);
  const auto shapes = phase_shapes(foam.films, n_phases);
  std::vector<int> faces(n_phases, 0);
  for (const auto& lamella : topology.lamella) {
    ++faces[lamella.phase_a];
    ++faces[lamella.phase_b];
  }
  std::vector<Row> rows;
  for (int p = 1; p < n_phases; ++p) {
    if (!foam.phases.is_bubble(p)) continue;
    const auto& [x, extent] = shapes[p];
    rows.push_back({foam.time, p, volume[p], foam.phases.target_volume[p], area[p], pressure.at(p), x.x, x.y,
                    x.z, extent.x, extent.y, extent.z, faces[p]});
  }
  return rows;
}

std::vector<Row> lamella_rows(const state::Foam& foam, const mesh::Topology& topology) {
  const auto area = mesh::lamella_areas(foam.films, topology);
  const auto liquid = sum_by_lamella(topology, foam.liquid.lamella_volume);
  const auto thinnest = min_half_thickness(foam, topology);
  const auto curvature = mean_curvatures(foam.films, topology);
  std::vector<Row> rows;
  for (int l = 0; l < topology.n_lamellae(); ++l)
    rows.push_back({foam.time, l, topology.lamella[l].phase_a, topology.lamella[l].phase_b, area[l],
                    liquid[l], thinnest[l], curvature[l]});
  return rows;
}

std::vector<Row> border_rows(const state::Foam& foam, const mesh::Topology& topology) {
  const int n = topology.n_borders();
  const auto length = mesh::border_lengths(foam.films, topology);
  const auto lambda = io::border_area(foam.films, topology, foam.liquid);
  std::vector<double> liquid(n, 0.0), smallest(n, infinity), largest(n, 0.0);
  for (std::size_t d = 0; d < lambda.size(); ++d) {
    const int b = topology.border_dof[d].border;
    liquid[b] += foam.liquid.border_volume[d];
    smallest[b] = std::min(smallest[b], lambda[d]);
    largest[b] = std::max(largest[b], lambda[d]);
  }
  std::vector<Row> rows;
  for (int b = 0; b < n; ++b) {
    const auto& phases = topology.border[b].phases;
    rows.push_back(
        {foam.time, b, phases[0], phases[1], phases[2], length[b], liquid[b], smallest[b], largest[b]});
  }
  return rows;
}

}  // namespace spume::simulation
