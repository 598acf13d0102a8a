#include "spume/meshing/moves.hpp"

#include <algorithm>
#include <vector>

#include "spume/meshing/forces.hpp"

namespace spume::meshing {

namespace {

constexpr double good_angle = 30;  // [degrees]

/// The film around each triangle of v does not change while v moves a little. Its normal is a sum over the
/// corners, which neighbours share.
class StarBadness {
 public:
  StarBadness(const StarMesh& m, int v) : m_(m), v_(v) {
    normal_.reserve(m.star[v].size());
    at_corner_.reserve(2 * m.star[v].size());
    for (int t : m.star[v]) {
      const mesh::FilmTriangle& triangle = m.films.triangle[t];
      Vec3 normal;
      for (int w : triangle.vertex) normal += at_corner(w, triangle.phase_a, triangle.phase_b);
      normal_.push_back(normal);
    }
  }
  double at(const Vec3& x) const {
    double worst = 0;
    for (std::size_t n = 0; n < normal_.size(); ++n)
      worst = std::max(worst, badness(m_.corners_with(m_.star[v_][n], v_, x), normal_[n]));
    return worst;
  }

 private:
  struct CornerNormal {
    int vertex;
    mesh::Phase phase_a, phase_b;
    Vec3 normal;
  };
  Vec3 at_corner(int w, mesh::Phase phase_a, mesh::Phase phase_b) {
    for (const CornerNormal& c : at_corner_)
      if (c.vertex == w && c.phase_a == phase_a && c.phase_b == phase_b) return c.normal;
    at_corner_.push_back({w, phase_a, phase_b, m_.film_normal_at(w, phase_a, phase_b)});
    return at_corner_.back().normal;
  }

  const StarMesh& m_;
  int v_;
  std::vector<Vec3> normal_;  // of the film around each triangle
  std::vector<CornerNormal> at_corner_;
};

}  // namespace

double badness_around(const StarMesh& m, int v, const Vec3& x) {
  return StarBadness(m, v).at(x);
}

int move_vertices(StarMesh& m, const mesh::Projection& project, std::span<const double> target) {
  constexpr int most_halvings = 4;
  constexpr double not_worth_it = 0.02;  // of the target
  const double good_enough = badness_of_angle(good_angle);
  int n_moved = 0;
  for (int v = 0; v < m.films.n_vertices(); ++v) {
    Vec3 step = wanted_displacement(m, target, v);
    const double least = not_worth_it * target[v];
    if (norm_squared(step) < least * least) continue;
    const Vec3 start = m.films.position[v];
    const StarBadness around(m, v);
    const double limit = std::max(around.at(start), good_enough);
    for (int halving = 0; halving <= most_halvings; ++halving, step *= 0.5) {
      const auto there = project(start + step, m.work.phases[v]);
      if (!there || around.at(*there) > limit) continue;
      m.move(v, *there);
      ++n_moved;
      break;
    }
  }
  return n_moved;
}

std::optional<Vec3> belonging(const StarMesh& m, const mesh::Projection& project, int v) {
  constexpr int n_rounds = 30;
  const Vec3& start = m.films.position[v];
  if (m.work.phases[v].size() <= 4) {
    const auto there = project(start, m.work.phases[v]);
    if (there || m.work.kind(v) != mesh::VertexKind::Junction) return there;
  }
  std::vector<mesh::PhaseSet> films;
  for (int t : m.star[v]) {
    const mesh::PhaseSet pair{m.films.triangle[t].phase_a, m.films.triangle[t].phase_b};
    if (std::find(films.begin(), films.end(), pair) == films.end()) films.push_back(pair);
  }
  Vec3 place = start;
  for (int round = 0; round < n_rounds; ++round) {
    Vec3 sum;
    for (const mesh::PhaseSet& pair : films) {
      const auto on_film = project(place, pair);
      if (!on_film) return std::nullopt;
      sum += *on_film - place;
    }
    place += sum / static_cast<double>(films.size());
  }
  return place;
}

int project_vertices(StarMesh& m, const mesh::Projection& project, double least_degrees) {
  const double acceptable = badness_of_angle(least_degrees);
  int n_off = 0;
  for (int v = 0; v < m.films.n_vertices(); ++v) {
    if (m.work.held[v] || m.star[v].empty()) continue;
    const auto there = belonging(m, project, v);
    const StarBadness around(m, v);
    if (there && around.at(*there) <= std::max(around.at(m.films.position[v]), acceptable))
      m.move(v, *there);
    else
      ++n_off;
  }
  return n_off;
}

}  // namespace spume::meshing
