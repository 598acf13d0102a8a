#include "spume/interface/volume_constants.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "spume/base/error.hpp"
#include "spume/base/union_find.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::interface {

namespace {

/// Area of the films between two phases [m²].
std::map<std::pair<mesh::Phase, mesh::Phase>, double> film_areas(const mesh::FilmMesh& films) {
  std::map<std::pair<mesh::Phase, mesh::Phase>, double> area;
  auto last = area.end();
  for (int t = 0; t < films.n_triangles(); ++t) {
    const std::pair pair{films.triangle[t].phase_a, films.triangle[t].phase_b};
    if (last == area.end() || last->first != pair) last = area.emplace(pair, 0.0).first;
    last->second += mesh::triangle_area(films, t);
  }
  return area;
}

}  // namespace

void raise_to_volumes(PhasePotentials& potentials, const mesh::FilmMesh& films, const state::Phases& phases,
                      double largest) {
  const int n = phases.count();
  UnionFind groups(n);
  for (const auto& t : films.triangle) groups.join(t.phase_a, t.phase_b);
  const auto is_free = [&](mesh::Phase p) { return groups.find(p) != p && phases.alive(p); };

  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [pair, area] : film_areas(films)) {
    const auto [a, b] = pair;
    const double half_area = 0.5 * area;
    if (is_free(a)) entries.emplace_back(a, a, half_area);
    if (is_free(b)) entries.emplace_back(b, b, half_area);
    if (!is_free(a) || !is_free(b)) continue;
    entries.emplace_back(a, b, -half_area);
    entries.emplace_back(b, a, -half_area);
  }
  const std::vector<double> volume = mesh::phase_volumes(films, n);
  Eigen::VectorXd missing = Eigen::VectorXd::Zero(n);
  for (mesh::Phase p = 0; p < n; ++p) {
    if (is_free(p))
      missing[p] = phases.target_volume[p] - volume[p];
    else
      entries.emplace_back(p, p, largest * largest);  // an area of ordinary size, for a regular matrix
  }
  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian);
  if (solver.info() != Eigen::Success)
    throw NumericalError("the volume constants of the phases have no solution");
  const Eigen::VectorXd constant = solver.solve(missing);
  for (mesh::Phase p = 1; p < n; ++p)
    if (is_free(p) && potentials.find(p)) potentials.raise(p, std::clamp(constant[p], -largest, largest));
}

}  // namespace spume::interface
