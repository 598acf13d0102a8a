#include "spume/mesh/parts.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "spume/base/contract.hpp"

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

Slabs::Slabs(const FilmMesh& mesh, int n_slabs) {
  std::vector<double> height(mesh.position.size());
  std::ranges::transform(mesh.position, height.begin(), &Vec3::z);
  for (int slab = 1; slab < n_slabs; ++slab) {
    const auto middle = height.begin() + static_cast<std::ptrdiff_t>(height.size()) * slab / n_slabs;
    std::ranges::nth_element(height, middle);
    bound_.push_back(*middle);
  }
}

int Slabs::of(const Vec3& x) const {
  return static_cast<int>(std::ranges::upper_bound(bound_, x.z) - bound_.begin());
}

std::vector<int> Slabs::of_triangles(const FilmMesh& mesh) const {
  std::vector<int> slab(mesh.triangle.size());
  std::ranges::transform(mesh.triangle, slab.begin(), [&](const FilmTriangle& t) {
    const auto& [a, b, c] = t.vertex;
    return std::min({of(mesh.position[a]), of(mesh.position[b]), of(mesh.position[c])});
  });
  return slab;
}

std::vector<int> seams_of_triangles(const FilmMesh& mesh, const Slabs& slabs, int n_cut, int n_rings) {
  const int none = slabs.count() - 1;
  std::vector<int> seam_of_vertex(mesh.position.size(), none);
  for (int v = 0; v < n_cut; ++v) seam_of_vertex[v] = slabs.of(mesh.position[v]) - 1;
  const auto seam_of = [&](const FilmTriangle& t) {
    const auto& [a, b, c] = t.vertex;
    return std::min({seam_of_vertex[a], seam_of_vertex[b], seam_of_vertex[c]});
  };
  std::vector<int> seam(mesh.triangle.size());
  for (int ring = 0; ring < n_rings; ++ring) {
    std::ranges::transform(mesh.triangle, seam.begin(), seam_of);
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (int v : mesh.triangle[t].vertex) seam_of_vertex[v] = std::min(seam_of_vertex[v], seam[t]);
  }
  return seam;
}

}  // namespace spume::mesh
