#include "spume/simulation/film_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "spume/base/error.hpp"
#include "spume/io/vtk_films.hpp"
#include "spume/mesh/measure.hpp"
#include "spume/meshing/mesh_films.hpp"
#include "spume/transport/transfer.hpp"

namespace spume::simulation {

namespace {

std::string place(const Vec3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x, x.y, x.z);
}

using Coordinates = std::array<double, 3>;
Coordinates key(const Vec3& x) {
  return {x.x + 0.0, x.y + 0.0, x.z + 0.0};  // −0 is 0
}

/// The vertex of each film point.
std::vector<int> join_points(const state::FilmFrame& frame, mesh::FilmMesh& films) {
  std::map<Coordinates, int> vertex_at;
  std::vector<int> vertex;
  for (const Vec3& x : frame.film_point) {
    if (!std::isfinite(norm(x))) throw InputError("a point is not finite");
    const auto [known, is_new] = vertex_at.try_emplace(key(x), films.n_vertices());
    if (is_new) films.position.push_back(x);
    vertex.push_back(known->second);
  }
  return vertex;
}

/// What the topology takes for granted: the numbers of phases are small, since arrays have a place for each,
/// and few of them meet at a vertex.
void check_phases(const mesh::FilmMesh& films) {
  std::vector<mesh::PhaseSet> around(films.n_vertices());
  for (const auto& t : films.triangle) {
    const mesh::Phase largest = std::max(t.phase_a, t.phase_b);
    if (largest > films.n_triangles())
      throw InputError(
          fmt::format("the triangle at {} has the phase {}, and there are only {} triangles: number "
                      "the bubbles 1, 2, …",
                      place(films.position[t.vertex[0]]), largest, films.n_triangles()));
    for (const int v : t.vertex)
      for (const mesh::Phase phase : {t.phase_a, t.phase_b}) {
        if (!around[v].contains(phase) && around[v].size() == mesh::PhaseSet::capacity)
          throw InputError(fmt::format("more than {} phases meet at {}: at a junction of a foam four do",
                                       mesh::PhaseSet::capacity, place(films.position[v])));
        around[v].insert(phase);
      }
  }
}

mesh::FilmMesh join(const state::FilmFrame& frame) {
  mesh::FilmMesh films;
  const std::vector<int> vertex = join_points(frame, films);
  for (const auto& t : frame.triangle) {
    const Vec3& x = frame.film_point[t.point[0]];
    if (t.phase_a == t.phase_b || t.phase_a < 0 || t.phase_b < 0)
      throw InputError(
          fmt::format("the triangle at {} lies between phases {} and {}: give two different "
                      "phases, 0 for the outside or 1, 2, … for bubbles",
                      place(x), t.phase_a, t.phase_b));
    films.triangle.push_back(mesh::make_triangle(vertex[t.point[0]], vertex[t.point[1]], vertex[t.point[2]],
                                                 t.phase_a, t.phase_b));
    if (!(mesh::triangle_area(films, films.n_triangles() - 1) > 0))
      throw InputError("a triangle has no area at " + place(x));
  }
  if (films.triangle.empty()) throw InputError("no triangles");
  check_phases(films);
  mesh::drop_unused_vertices(films);
  return films;
}

/// Edges of triangles and the triangles around each.
using Edges = std::map<std::pair<int, int>, std::vector<int>>;

Edges edges_of(const mesh::FilmMesh& films) {
  Edges triangles;
  for (int t = 0; t < films.n_triangles(); ++t)
    for (int e = 0; e < 3; ++e)
      triangles[std::minmax(films.triangle[t].vertex[e], films.triangle[t].vertex[(e + 1) % 3])].push_back(t);
  return triangles;
}

constexpr const char* same_coordinates =
    "points of films that meet need the same coordinates to the last digit";

/// Films whose points differ in the last digit do not meet, and their Plateau border would be missing.
void check_poly_lines(const state::FilmFrame& frame, const SourcedFilms& sourced) {
  std::set<Coordinates> on_border;
  for (const auto& dof : sourced.topology.border_dof)
    on_border.insert(key(sourced.films.position[dof.vertex]));
  for (const auto& line : frame.border_line)
    for (const int p : line)
      if (!on_border.contains(key(frame.border_point[p])))
        throw InputError(fmt::format("a poly-line runs through {}, where no three films meet: {}",
                                     place(frame.border_point[p]), same_coordinates));
}

/// The same without poly-lines: two vertices where films end are one point that was rounded in two ways.
void check_free_vertices(const mesh::FilmMesh& films, const Edges& edges) {
  constexpr double rounding = 1e-6;  // of an edge: that of numbers in single precision, with some room
  std::map<int, double> reach;       // of each vertex at which a film ends [m]
  double largest = 0;
  for (const auto& [ends, around] : edges) {
    if (around.size() != 1) continue;
    const double length = rounding * norm(films.edge(ends.first, ends.second));
    largest = std::max(largest, length);
    for (const int v : {ends.first, ends.second}) {
      const auto [known, is_new] = reach.try_emplace(v, length);
      if (!is_new) known->second = std::min(known->second, length);
    }
  }
  std::map<Coordinates, std::vector<int>> bins;  // of the edge `largest`, by multiples of it
  for (const auto& [v, unused] : reach) {
    const Vec3 x = films.position[v] / largest;
    const Coordinates bin{std::floor(x.x), std::floor(x.y), std::floor(x.z)};
    for (int n = 0; n < 27; ++n) {
      const auto near = bins.find({bin[0] + n % 3 - 1, bin[1] + n / 3 % 3 - 1, bin[2] + n / 9 - 1});
      if (near == bins.end()) continue;
      for (const int w : near->second)
        if (const double apart = norm(films.edge(v, w)); apart <= std::min(reach[v], reach[w]))
          throw InputError(fmt::format("films end at two points {:.3g} m apart at {}: {}", apart,
                                       place(films.position[v]), same_coordinates));
    }
    bins[bin].push_back(v);
  }
}

/// Counts the edges at which films end; throws where one is what no edge of a foam can be.
int check_edges(const mesh::FilmMesh& films, const mesh::Topology& topology, const Edges& edges) {
  std::map<std::pair<int, int>, bool> border;
  for (const auto& edge : topology.border_edge) border[{edge.vertex[0], edge.vertex[1]}] = true;
  int n_free = 0;
  for (const auto& [ends, around] : edges) {
    const Vec3& x = films.position[ends.first];
    if (around.size() == 1) ++n_free;
    if (around.size() > 3 || (around.size() == 3 && !border.contains(ends)))
      throw InputError(fmt::format(
          "{} triangles meet at an edge at {}: at a Plateau border three films between three phases meet",
          around.size(), place(x)));
    if (around.size() != 2) continue;
    const auto &a = films.triangle[around[0]], &b = films.triangle[around[1]];
    const auto runs_up = [&](const mesh::FilmTriangle& t) {
      for (int e = 0; e < 3; ++e)
        if (t.vertex[e] == ends.first && t.vertex[(e + 1) % 3] == ends.second) return true;
      return false;
    };
    if (a.phase_a != b.phase_a || a.phase_b != b.phase_b)
      throw InputError(fmt::format("films {}|{} and {}|{} meet at {} without a third: no Plateau border",
                                   a.phase_a, a.phase_b, b.phase_a, b.phase_b, place(x)));
    if (runs_up(a) == runs_up(b))
      throw InputError(
          fmt::format("two triangles of film {}|{} at {} disagree on which side phase {} is: the normal of "
                      "every triangle "
                      "(right-hand rule) points from phase_a into phase_b",
                      a.phase_a, a.phase_b, place(x), a.phase_a));
  }
  return n_free;
}

double checked(double value, const char* what, const Vec3& x) {
  if (value > 0 && std::isfinite(value)) return value;
  throw InputError(fmt::format("{} is {} at {}: it must be positive", what, value, place(x)));
}

/// η and λ of a frame as volumes of the dofs of its mesh.
state::FilmLiquid liquid_of(const state::FilmFrame& frame, const SourcedFilms& sourced) {
  const auto& [films, topology, unused, n_free] = sourced;
  state::FilmLiquid liquid = transport::uniform_liquid(films, topology, 1, 1);
  const auto area = mesh::film_dof_areas(films, topology);
  for (int t = 0; t < films.n_triangles(); ++t)
    for (int c = 0; c < 3; ++c) {
      const int dof = topology.corner_dof[t][c];
      const Vec3& x = films.position[topology.film_dof[dof].vertex];
      // make_triangle() may have exchanged corners.
      const auto& points = frame.triangle[t].point;
      const auto point =
          std::ranges::find_if(points, [&](int p) { return key(frame.film_point[p]) == key(x); });
      liquid.lamella_volume[dof] =
          2 * area[dof] * checked(frame.half_thickness[*point], "half_thickness_m", x);
    }
  std::map<Coordinates, double> lambda_at;
  for (std::size_t p = 0; p < frame.border_point.size(); ++p)
    lambda_at[key(frame.border_point[p])] = frame.border_area[p];
  const auto length = mesh::border_dof_lengths(films, topology);
  for (std::size_t d = 0; d < length.size(); ++d) {
    const Vec3& x = films.position[topology.border_dof[d].vertex];
    const auto found = lambda_at.find(key(x));
    if (found == lambda_at.end())
      throw InputError(fmt::format(
          "films meet in a Plateau border at {}, but no poly-line has a point there with border_area_m2; "
          "give one, or set foam.films.liquid = \"uniform\"",
          place(x)));
    liquid.border_volume[d] = length[d] * checked(found->second, "border_area_m2", x);
  }
  return liquid;
}

}  // namespace

SourcedFilms join_films(const state::FilmFrame& frame, bool with_liquid, double half_thickness,
                        double border_area) {
  SourcedFilms sourced;
  sourced.films = join(frame);
  sourced.topology = mesh::build_topology(sourced.films);
  const Edges edges = edges_of(sourced.films);
  sourced.n_free_edges = check_edges(sourced.films, sourced.topology, edges);
  check_poly_lines(frame, sourced);
  check_free_vertices(sourced.films, edges);
  sourced.liquid =
      with_liquid ? liquid_of(frame, sourced)
                  : transport::uniform_liquid(sourced.films, sourced.topology, half_thickness, border_area);
  return sourced;
}

SourcedFilms load_films(const FilmsSource& source, double half_thickness, double border_area) {
  const state::FilmFrame frame = io::read_films(source.file);
  try {
    return join_films(frame, source.liquid == FilmsSource::Liquid::File, half_thickness, border_area);
  } catch (const InputError& error) {
    throw InputError(source.file + ": " + error.what());
  }
}

std::vector<double> volumes_of(const mesh::FilmMesh& films) {
  int n_phases = 1;
  for (const auto& t : films.triangle) n_phases = std::max(n_phases, t.phase_b + 1);
  std::vector<double> volume = mesh::phase_volumes(films, n_phases);
  const std::vector<double> area = mesh::phase_areas(films, n_phases);
  volume[0] = 0;
  for (int p = 1; p < n_phases; ++p)
    if (!(volume[p] > 0)) volume[p] = std::pow(area[p], 1.5) / (6 * std::sqrt(std::numbers::pi));
  return volume;
}

state::FilmNetwork network_of(const mesh::FilmMesh& films, const state::FilmLiquid& liquid) {
  state::FilmNetwork network;
  network.mesh = films;
  network.topology = mesh::build_topology(films);
  const auto& topology = network.topology;
  const auto area = mesh::film_dof_areas(network.mesh, topology);
  network.half_thickness.resize(area.size());
  for (std::size_t d = 0; d < area.size(); ++d)
    network.half_thickness[d] = liquid.lamella_volume[d] / (2 * area[d]);
  network.curvature_squared = meshing::curvature_squared(network.mesh, topology);

  std::vector<double> volume(network.mesh.position.size(), 0.0), length(volume.size(), 0.0);
  const auto dof_length = mesh::border_dof_lengths(network.mesh, topology);
  for (std::size_t d = 0; d < topology.border_dof.size(); ++d) {
    volume[topology.border_dof[d].vertex] += liquid.border_volume[d];
    length[topology.border_dof[d].vertex] += dof_length[d];
  }
  network.border_area.assign(volume.size(), 0.0);
  for (std::size_t v = 0; v < volume.size(); ++v)
    if (length[v] > 0) network.border_area[v] = volume[v] / length[v];
  return network;
}

}  // namespace spume::simulation
