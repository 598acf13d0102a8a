#include "spume/meshing/mesh_films.hpp"

#include <algorithm>
#include <cmath>

#include "spume/base/vec3.hpp"

namespace spume::meshing {

namespace {

/// Points on Plateau borders in cubic bins, to find how far a point is from the nearest, up to a reach.
class BorderDistance {
 public:
  BorderDistance(const mesh::FilmMesh& films, double reach) : domain_(films.domain), reach_(reach) {
    const mesh::Topology topology = mesh::build_topology(films);
    for (int v = 0; v < films.n_vertices(); ++v)
      if (topology.vertex_kind[v] != mesh::VertexKind::Film) add(domain_.inside(films.position[v]));
    std::sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) { return a.bin < b.bin; });
  }

  /// Distance to the nearest border vertex [m], or the reach where that is nearer.
  double operator()(const Vec3& x) const {
    double nearest = reach_ * reach_;
    domain_.for_each_image(x, reach_, [&](const Vec3& image) { search(image, nearest); });
    return std::sqrt(nearest);
  }

 private:
  using Bin = std::array<int, 3>;
  struct Point {
    Bin bin;
    Vec3 position;
  };

  void add(const Vec3& x) { points_.push_back({bin_of(x), x}); }
  void search(const Vec3& x, double& nearest_squared) const {
    const Bin centre = bin_of(x);
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj)
        for (int dk = -1; dk <= 1; ++dk) {
          const Bin bin{centre[0] + di, centre[1] + dj, centre[2] + dk};
          auto p = std::lower_bound(points_.begin(), points_.end(), bin,
                                    [](const Point& a, const Bin& b) { return a.bin < b; });
          for (; p != points_.end() && p->bin == bin; ++p)
            nearest_squared = std::min(nearest_squared, norm_squared(p->position - x));
        }
  }
  Bin bin_of(const Vec3& x) const {
    return {static_cast<int>(std::floor(x.x / reach_)), static_cast<int>(std::floor(x.y / reach_)),
            static_cast<int>(std::floor(x.z / reach_))};
  }

  Domain domain_;
  double reach_;
  std::vector<Point> points_;
};

}  // namespace

MeshingReport improve(mesh::FilmMesh& films, const mesh::Projection& project, double h,
                      const MeshingParameters& parameters) {
  const double fine = parameters.edge_at_borders * h, coarse = parameters.edge * h;
  const BorderDistance distance(films, std::max((coarse - fine) / parameters.grading, h));
  const mesh::TargetLength target = [&](const Vec3& x) {
    return std::min(coarse, fine + parameters.grading * distance(x));
  };

  MeshingReport report;
  mesh::RemeshParameters remeshing;
  remeshing.split_above = 1.4;
  remeshing.smoothing_sweeps = parameters.sweeps;
  report.remesh = mesh::remesh(films, target, project, remeshing);
  report.after = mesh::measure_quality(films, mesh::build_topology(films));
  return report;
}

}  // namespace spume::meshing
