#include "spume/flow/film_pull.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "spume/mesh/film_pieces.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::flow {

namespace {

constexpr double epsilon = 1e-3;

/// What forces on the vertices of films count by.
struct VertexPull {
  Vec3 direction;    ///< normal to the film inside one, else along the border; zero where all counts
  bool inside_film;  ///< the part along `direction` counts, else the part across it
  double area;       ///< a third of the triangles there [m²]

  Vec3 counts(const Vec3& force) const {
    const Vec3 along = dot(force, direction) * direction;
    return inside_film ? along : force - along;
  }
};

std::vector<VertexPull> vertex_pulls(const mesh::FilmMesh& films, const mesh::Topology& topology) {
  std::vector<VertexPull> pull(films.position.size());
  for (int t = 0; t < films.n_triangles(); ++t) {
    const Vec3 doubled_area = mesh::doubled_area_normal(films, t);
    const double third = norm(doubled_area) / 6;
    for (int v : films.triangle[t].vertex) {
      pull[v].direction += doubled_area;
      pull[v].area += third;
    }
  }
  const std::vector<Vec3> tangent = mesh::border_tangents(films, topology);
  for (int v = 0; v < films.n_vertices(); ++v) {
    pull[v].inside_film =
        topology.vertex_kind[v] == mesh::VertexKind::Film && topology.vertex_phases[v].size() == 2;
    pull[v].direction = pull[v].inside_film ? normalized(pull[v].direction) : tangent[v];
  }
  return pull;
}

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Force and moment about the middle of a piece of films, or a and b: six numbers of one unit, as places x −
/// middle are in units of sqrt(area of the piece).
Vector6 six(const Vec3& place, const Vec3& force) {
  const Vec3 m = cross(place, force);
  return (Vector6() << force.x, force.y, force.z, m.x, m.y, m.z).finished();
}

/// What one connected piece of films misses, and what it gets for that.
struct Piece {
  Vec3 middle;                        ///< of its area [m]
  double area = 0;                    ///< [m²]
  Vector6 missing = Vector6::Zero();  ///< sum and moment of what was taken out [N]
  Matrix6 answer = Matrix6::Zero();   ///< sum and moment of A_v P_v (a + b × x_v) for unit a and b
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();  ///< Σ A_v x x^T
  Vec3 a, b;                                         ///< [N/m²]

  double per_length = 0;  ///< 1/sqrt(area) [1/m]

  Vec3 place(const Vec3& x) const { return per_length * (x - middle); }
  void take(const Vec3& x, const VertexPull& pull, const Vec3& taken);
  void solve(const std::array<bool, 3>& bounded);
};

void Piece::take(const Vec3& x, const VertexPull& pull, const Vec3& taken) {
  const Vec3 r = place(x);
  missing += six(r, taken);
  const Eigen::Vector3d s(r.x, r.y, r.z), weighted = pull.area * s;
  spread.noalias() += weighted * s.transpose();
  const Vector6 along = six(r, pull.direction),
                signed_area = (pull.inside_film ? pull.area : -pull.area) * along;
  answer.noalias() += signed_area * along.transpose();
  if (pull.inside_film) return;
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vector6 any = six(r, axis);
    answer += pull.area * any * any.transpose();
  }
}

void Piece::solve(const std::array<bool, 3>& bounded) {
  Matrix6 matrix = answer;  // and ε of the same with P_v = 1; the middle has Σ A_v x = 0
  for (int d = 0; d < 3; ++d) matrix(d, d) += epsilon * area;
  matrix.bottomRightCorner<3, 3>() += epsilon * (spread.trace() * Eigen::Matrix3d::Identity() - spread);
  for (int d = 0; d < 3; ++d) {
    if (bounded[(d + 1) % 3] && bounded[(d + 2) % 3]) continue;
    matrix.row(3 + d).setZero();  // no moment about this axis
    matrix.col(3 + d).setZero();
    matrix(3 + d, 3 + d) = area;
    missing(3 + d) = 0;
  }
  const Vector6 x = matrix.ldlt().solve(missing);
  a = {x(0), x(1), x(2)};
  b = {x(3), x(4), x(5)};
}

std::vector<Piece> measure_pieces(const mesh::FilmPieces& pieces, const std::vector<VertexPull>& pull) {
  std::vector<Piece> measured(pieces.count);
  for (std::size_t v = 0; v < pull.size(); ++v) {
    if (pieces.of_vertex[v] < 0) continue;
    Piece& piece = measured[pieces.of_vertex[v]];
    piece.middle += pull[v].area * pieces.position[v];
    piece.area += pull[v].area;
  }
  for (Piece& piece : measured) {
    if (!(piece.area > 0)) continue;
    piece.middle *= 1 / piece.area;
    piece.per_length = 1 / std::sqrt(piece.area);
  }
  return measured;
}

}  // namespace

void take_out_sliding(const mesh::FilmMesh& films, const mesh::Topology& topology, std::vector<Vec3>& force) {
  const std::vector<VertexPull> pull = vertex_pulls(films, topology);
  const mesh::FilmPieces pieces = mesh::film_pieces(films, topology);
  std::vector<Piece> measured = measure_pieces(pieces, pull);
  for (int v = 0; v < films.n_vertices(); ++v) {
    if (!(pull[v].area > 0)) continue;
    const Vec3 counts = pull[v].counts(force[v]);
    measured[pieces.of_vertex[v]].take(pieces.position[v], pull[v], force[v] - counts);
    force[v] = counts;
  }
  for (int p = 0; p < pieces.count; ++p) measured[p].solve(pieces.bounded[p]);
  for (int v = 0; v < films.n_vertices(); ++v) {
    if (!(pull[v].area > 0)) continue;
    const Piece& piece = measured[pieces.of_vertex[v]];
    const Vec3 rigid = piece.a + cross(piece.b, piece.place(pieces.position[v]));
    force[v] += pull[v].area * (pull[v].counts(rigid) + epsilon * rigid);
  }
}

}  // namespace spume::flow
