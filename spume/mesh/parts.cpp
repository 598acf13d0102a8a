#include "spume/mesh/parts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "spume/base/contract.hpp"
#include "spume/base/union_find.hpp"

namespace spume::mesh {

namespace {

constexpr int on_cut = -1, unused = -2;

/// The part that has all triangles of a vertex, or `on_cut` or `unused`.
std::vector<int> parts_of_vertices(const FilmMesh& mesh, const std::vector<int>& part_of_triangle) {
  std::vector<int> part(mesh.position.size(), unused);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int v : mesh.triangle[t].vertex) {
      if (part[v] == unused) part[v] = part_of_triangle[t];
      if (part[v] != part_of_triangle[t]) part[v] = on_cut;
    }
  return part;
}

/// Parts of a mesh one after another. Triangles refer to vertex n of their part by n, and to vertex n on the
/// cuts by −1 − n.
struct Pieces {
  std::vector<Vec3> position;  ///< of vertices that are not on a cut
  std::vector<FilmTriangle> triangle;
  std::vector<std::array<int, 2>> n_of_part;  ///< vertices, triangles

  void append(const Pieces& other) {
    position.insert(position.end(), other.position.begin(), other.position.end());
    triangle.insert(triangle.end(), other.triangle.begin(), other.triangle.end());
    n_of_part.insert(n_of_part.end(), other.n_of_part.begin(), other.n_of_part.end());
  }
};

Pieces piece(std::vector<Vec3> position, std::vector<FilmTriangle> triangle) {
  const std::array<int, 2> n{static_cast<int>(position.size()), static_cast<int>(triangle.size())};
  return {std::move(position), std::move(triangle), {n}};
}

/// A mesh with the parts that its triangles are dealt to.
class DividedMesh {
 public:
  DividedMesh(const FilmMesh& mesh, const std::vector<int>& part_of_triangle, int n_parts)
      : mesh_(mesh),
        part_of_vertex_(parts_of_vertices(mesh, part_of_triangle)),
        number_(mesh.position.size()),
        vertices_(n_parts),
        triangles_(n_parts) {
    for (int v = 0; v < mesh.n_vertices(); ++v) {
      if (part_of_vertex_[v] == unused) continue;
      auto& list = part_of_vertex_[v] == on_cut ? cut_ : vertices_[part_of_vertex_[v]];
      number_[v] = static_cast<int>(list.size());
      list.push_back(v);
    }
    for (int t = 0; t < mesh.n_triangles(); ++t) triangles_[part_of_triangle[t]].push_back(t);
  }

  const std::vector<int>& cut() const { return cut_; }
  /// A part after the work on it.
  Pieces worked_on(int part, const PartWork& work) const;
  /// A part as it is.
  Pieces unchanged(int part) const;
  FilmMesh assembled(const Pieces& pieces) const;

 private:
  /// Numbers on the cuts of those vertices there that a part has, in increasing order.
  std::vector<int> cut_of(int part) const;

  const FilmMesh& mesh_;
  std::vector<int> part_of_vertex_;
  std::vector<int> number_;                             // of a vertex in its part or on the cuts
  std::vector<int> cut_;                                // vertices
  std::vector<std::vector<int>> vertices_, triangles_;  // of each part
};

std::vector<int> DividedMesh::cut_of(int part) const {
  std::vector<int> numbers;
  for (int t : triangles_[part])
    for (int v : mesh_.triangle[t].vertex)
      if (part_of_vertex_[v] == on_cut) numbers.push_back(number_[v]);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

Pieces DividedMesh::worked_on(int part, const PartWork& work) const {
  const std::vector<int> cut = cut_of(part);
  const int n_cut = static_cast<int>(cut.size());
  FilmMesh own{{}, {}, mesh_.domain};
  for (int n : cut) own.position.push_back(mesh_.position[cut_[n]]);
  for (int v : vertices_[part]) own.position.push_back(mesh_.position[v]);
  for (int t : triangles_[part]) {
    FilmTriangle triangle = mesh_.triangle[t];
    for (int& v : triangle.vertex)
      v = part_of_vertex_[v] == on_cut
              ? static_cast<int>(std::lower_bound(cut.begin(), cut.end(), number_[v]) - cut.begin())
              : n_cut + number_[v];
    own.triangle.push_back(triangle);
  }

  work(own, n_cut);

  for (FilmTriangle& t : own.triangle)
    for (int& v : t.vertex) v = v < n_cut ? -1 - cut[v] : v - n_cut;
  own.position.erase(own.position.begin(), own.position.begin() + n_cut);
  return piece(std::move(own.position), std::move(own.triangle));
}

Pieces DividedMesh::unchanged(int part) const {
  std::vector<Vec3> position;
  for (int v : vertices_[part]) position.push_back(mesh_.position[v]);
  std::vector<FilmTriangle> triangles;
  for (int t : triangles_[part]) {
    FilmTriangle triangle = mesh_.triangle[t];
    for (int& v : triangle.vertex) v = part_of_vertex_[v] == on_cut ? -1 - number_[v] : number_[v];
    triangles.push_back(triangle);
  }
  return piece(std::move(position), std::move(triangles));
}

FilmMesh DividedMesh::assembled(const Pieces& pieces) const {
  FilmMesh mesh{{}, pieces.triangle, mesh_.domain};
  for (int v : cut_) mesh.position.push_back(mesh_.position[v]);
  mesh.position.insert(mesh.position.end(), pieces.position.begin(), pieces.position.end());
  int first_vertex = static_cast<int>(cut_.size());
  auto triangle = mesh.triangle.begin();
  for (const auto& [n_vertices, n_triangles] : pieces.n_of_part) {
    for (const auto end = triangle + n_triangles; triangle != end; ++triangle)
      for (int& v : triangle->vertex) v = v < 0 ? -1 - v : first_vertex + v;
    first_vertex += n_vertices;
  }
  return mesh;
}

/// The axis along which the images of the vertices in the box spread most; the last of those as good.
int longest_axis(const FilmMesh& mesh) {
  Vec3 lower = Vec3{1, 1, 1} * std::numeric_limits<double>::infinity(), upper = -1.0 * lower;
  for (const Vec3& x : mesh.position) {
    const Vec3 inside = mesh.domain.inside(x);
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], inside[d]);
      upper[d] = std::max(upper[d], inside[d]);
    }
  }
  int longest = 2;
  for (int d : {1, 0})
    if (upper[d] - lower[d] > upper[longest] - lower[longest]) longest = d;
  return longest;
}

}  // namespace

int work_in_parts(FilmMesh& mesh, const std::vector<int>& part_of_triangle, int n_parts, const PartWork& work,
                  const parallel::Communicator& ranks) {
  expects(part_of_triangle.size() == mesh.triangle.size(), "every triangle has a part");
  const DividedMesh divided(mesh, part_of_triangle, n_parts + 1);
  const std::vector<int> share = ranks.shares(n_parts);
  Pieces own;
  ranks.together([&] {
    for (int p = share[ranks.rank()]; p < share[ranks.rank() + 1]; ++p)
      own.append(divided.worked_on(p, work));
  });
  std::vector<int> of_rank;
  Pieces all{ranks.joined(std::move(own.position), of_rank), ranks.joined(std::move(own.triangle), of_rank),
             ranks.joined(std::move(own.n_of_part), of_rank)};
  all.append(divided.unchanged(n_parts));
  const int n_cut = static_cast<int>(divided.cut().size());
  mesh = divided.assembled(all);
  return n_cut;
}

Slabs::Slabs(const FilmMesh& mesh, int n_at_most, double least_thickness)
    : domain_(mesh.domain), axis_(longest_axis(mesh)) {
  expects(n_at_most > 0 && std::has_single_bit(static_cast<unsigned>(n_at_most)),
          "the number of slabs is a power of two");
  std::vector<double> heights(mesh.position.size());
  std::ranges::transform(mesh.position, heights.begin(), [&](const Vec3& x) { return height(x); });
  for (int slab = 1; slab < n_at_most; ++slab) {
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size()) * slab / n_at_most;
    std::ranges::nth_element(heights, middle);
    bound_.push_back(*middle);
  }
  while (!bound_.empty() && thinnest() < least_thickness) {  // every second bound makes half as many
    const std::vector<double> all = std::move(bound_);
    bound_.clear();
    for (std::size_t n = 1; n < all.size(); n += 2) bound_.push_back(all[n]);
  }
}

double Slabs::height(const Vec3& x) const {
  return domain_.periodic[axis_] ? domain_.inside(x)[axis_] : x[axis_];
}

/// The least thickness of a slab between two others.
double Slabs::thinnest() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 1; n < bound_.size(); ++n) least = std::min(least, bound_[n] - bound_[n - 1]);
  if (!domain_.periodic[axis_]) return least;
  const double lower = domain_.lower[axis_], upper = lower + domain_.size[axis_];
  return std::min({least, bound_.front() - lower, upper - bound_.back()});
}

int Slabs::of(const Vec3& x) const {
  return static_cast<int>(std::ranges::upper_bound(bound_, height(x)) - bound_.begin());
}

std::vector<int> Slabs::of_triangles(const FilmMesh& mesh) const {
  std::vector<int> slab(mesh.triangle.size());
  std::ranges::transform(mesh.triangle, slab.begin(), [&](const FilmTriangle& t) {
    const auto& [a, b, c] = t.vertex;
    return std::min({of(mesh.position[a]), of(mesh.position[b]), of(mesh.position[c])});
  });
  return slab;
}

Seams seams_around_cuts(const FilmMesh& mesh, const Slabs& slabs, int n_cut, int n_rings) {
  const int none = slabs.count() - 1;
  std::vector<int> cut_near(mesh.position.size(),
                            none);  // of vertices: the lowest cut found within the rings
  for (int v = 0; v < n_cut; ++v) cut_near[v] = slabs.of(mesh.position[v]) - 1;
  std::vector<int> seam(mesh.triangle.size());
  UnionFind overlapping(none + 1);
  for (int ring = 0; ring < n_rings; ++ring) {
    for (int t = 0; t < mesh.n_triangles(); ++t) {
      const auto& [a, b, c] = mesh.triangle[t].vertex;
      seam[t] = std::min({cut_near[a], cut_near[b], cut_near[c]});
      for (int v : {a, b, c})
        if (cut_near[v] != none) overlapping.join(seam[t], cut_near[v]);
    }
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (int v : mesh.triangle[t].vertex) cut_near[v] = std::min(cut_near[v], seam[t]);
  }
  std::vector<int> seam_of_cut;
  const int count = overlapping.number(seam_of_cut) - 1;  // but for `none`, which is the last
  for (int& s : seam) s = seam_of_cut[s];
  return {std::move(seam), count};
}

}  // namespace spume::mesh
