#include "spume/transport/border_profile.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "spume/transport/cubic_spline.hpp"

namespace spume::transport {

namespace {

/// f'' at the knots from the two secants there; the ends of an open line take their neighbours'.
std::vector<double> second_differences(std::span<const double> s, std::span<const double> f, bool closed) {
  const std::size_t n = s.size() - 1;  // pieces
  const auto secant = [&](std::size_t k) { return (f[k + 1] - f[k]) / (s[k + 1] - s[k]); };
  std::vector<double> second(n + 1);
  for (std::size_t k = 1; k < n; ++k) second[k] = 2 * (secant(k) - secant(k - 1)) / (s[k + 1] - s[k - 1]);
  if (closed) {
    const double width = (s[1] - s[0]) + (s[n] - s[n - 1]);
    second[0] = second[n] = 2 * (secant(0) - secant(n - 1)) / width;
  } else {
    second[0] = second[1];
    second[n] = second[n - 1];
  }
  return second;
}

}  // namespace

BorderProfile::BorderProfile(const LiquidMesh& mesh, std::span<const double> volume, double h) {
  const double least_length = 1e-6 * h;
  std::vector<double> value(volume.size());
  for (std::size_t d = 0; d < value.size(); ++d)
    value[d] = volume[d] / std::max(mesh.dof_length[d], least_length);

  // Linear to begin with.
  std::vector<int> border_of_edge;
  for (const auto& edge : mesh.topology.border_edge) {
    const double f0 = value[edge.border_dof[0]], f1 = value[edge.border_dof[1]];
    const double length = norm(mesh.films.edge(edge.vertex[0], edge.vertex[1]));
    const double slope = length > 0 ? (f1 - f0) / length : 0;
    piece_.push_back({length, f0, f1, slope, slope, std::min(f0, f1), std::max(f0, f1)});
    border_of_edge.push_back(edge.border);
  }
  const Grouping edges = group_members(mesh.topology.n_borders(), border_of_edge);
  for (int b = 0; b < mesh.topology.n_borders(); ++b) fit_border(mesh, b, edges[b], value);
}

void BorderProfile::fit_border(const LiquidMesh& mesh, int border, std::span<const int> edges,
                               std::span<const double> value) {
  const auto& line = mesh.topology.border[border];
  const std::size_t n_pieces = edges.size();
  // A border that branches is no line; three different vertices at least on a ring of four, four on an open
  // line.
  if (line.vertices.size() != n_pieces + 1 || n_pieces < (line.closed ? 4u : 3u)) return;

  std::map<std::pair<int, int>, int> edge_between;
  for (int e : edges) {
    const auto& vertex = mesh.topology.border_edge[e].vertex;
    edge_between[{vertex[0], vertex[1]}] = e;
  }
  std::vector<double> s{0}, f;
  std::vector<int> edge_of_piece;
  std::vector<char> forward;
  for (std::size_t k = 0; k < n_pieces; ++k) {
    const int a = line.vertices[k], b = line.vertices[k + 1];
    const auto found = edge_between.find(std::minmax(a, b));
    if (found == edge_between.end()) return;
    const auto& edge = mesh.topology.border_edge[found->second];
    edge_of_piece.push_back(found->second);
    forward.push_back(edge.vertex[0] == a);
    s.push_back(s.back() + piece_[found->second].length);
    if (k == 0) f.push_back(value[edge.border_dof[forward[0] ? 0 : 1]]);
    f.push_back(value[edge.border_dof[forward[k] ? 1 : 0]]);
  }
  // Vertices in one place leave no spline through them.
  for (std::size_t k = 0; k < n_pieces; ++k)
    if (s[k + 1] - s[k] < 1e-6 * s.back()) return;

  const std::vector<double> slope = line.closed ? periodic_spline_slopes(s, f) : spline_slopes(s, f);
  const std::vector<double> second = second_differences(s, f, line.closed);
  const auto value_at = [&](std::ptrdiff_t k) {
    const auto n = static_cast<std::ptrdiff_t>(n_pieces);
    return f[line.closed ? (k + n) % n : std::clamp<std::ptrdiff_t>(k, 0, n)];
  };
  for (std::size_t k = 0; k < n_pieces; ++k) {
    Piece& piece = piece_[edge_of_piece[k]];
    const double sign = forward[k] ? 1 : -1;
    piece.slope0 = sign * slope[forward[k] ? k : k + 1];
    piece.slope1 = sign * slope[forward[k] ? k + 1 : k];
    const auto here = static_cast<std::ptrdiff_t>(k);
    const double before = value_at(here - 1), after = value_at(here + 2);
    // A smooth crest lies between two vertices as often as on one; a parabola with the smaller curvature of
    // the two ends may rise that much above them. Where the curvature changes sign (a step, a spike) nothing
    // may.
    const bool smooth = second[k] * second[k + 1] > 0;
    const double rise =
        smooth ? std::min(std::abs(second[k]), std::abs(second[k + 1])) * piece.length * piece.length / 8 : 0;
    piece.least = std::min({piece.least, before, after});
    piece.most = std::max({piece.most, before, after});
    const double smaller = std::min(piece.value0, piece.value1);
    if (second[k] < 0)
      piece.most = std::max(piece.most, std::max(piece.value0, piece.value1) + rise);
    else  // never to nothing: drainage divides by λ
      piece.least = std::min(piece.least, std::max(0.5 * smaller, smaller - rise));
  }
}

double BorderProfile::at(int edge, double t) const {
  const Piece& piece = piece_[edge];
  const double value = hermite(t, piece.length, piece.value0, piece.value1, piece.slope0, piece.slope1);
  return std::clamp(value, piece.least, piece.most);
}

}  // namespace spume::transport
