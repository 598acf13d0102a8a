#include "spume/simulation/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "spume/base/error.hpp"
#include "spume/simulation/cluster.hpp"
#include "spume/simulation/film_source.hpp"
#include "spume/simulation/labels.hpp"

namespace spume::simulation {

namespace {

double sphere_radius(double volume) {
  return std::cbrt(volume * 3 / (4 * std::numbers::pi));
}

void check_inside(const std::vector<BubbleShape>& bubbles, const grid::Box& box) {
  constexpr int margin_cells = 4;
  const double margin = margin_cells * box.spacing();
  for (std::size_t b = 0; b < bubbles.size(); ++b)
    for (int d = 0; d < 3; ++d)
      if (bubbles[b].center[d] - bubbles[b].semi_axes[d] < box.lower[d] + margin ||
          bubbles[b].center[d] + bubbles[b].semi_axes[d] > box.upper[d] - margin)
        throw InputError(
            fmt::format("bubble {} reaches to within {} cells ({:.3g} m) of the edge of the box across {}: "
                        "centre {:.6g} m, radius "
                        "{:.6g} m, box from {:.6g} to {:.6g} m; enlarge [domain] or move the bubble",
                        b + 1, margin_cells, margin, "xyz"[d], bubbles[b].center[d], bubbles[b].semi_axes[d],
                        box.lower[d], box.upper[d]));
}

/// Power cells of the bubbles. Where the case has a cluster, gas enclosed between bubbles is shared by them;
/// among the user's own bubbles it becomes a bubble of its own.
Start power_cells(const Case& run_case, std::vector<BubbleShape> bubbles) {
  const double radius = mean_radius(bubbles), h = run_case.box.spacing();
  const grid::Box box = run_case.box;
  std::vector<char> shared;
  if (run_case.foam.cluster) shared = enclosed_pockets(bubbles, box);
  Start start;
  start.target_volume.assign(bubbles.size() + 1, 0.0);
  const auto is_shared = [h, box, shared = std::move(shared)](const Vec3& x) {
    if (shared.empty()) return false;
    Index3 cell;
    for (int d = 0; d < 3; ++d)
      cell[d] = std::clamp(static_cast<int>((x[d] - box.lower[d]) / h), 0, box.cells[d] - 1);
    return shared[(static_cast<std::size_t>(cell.k) * box.cells.j + cell.j) * box.cells.i + cell.i] != 0;
  };
  start.potential = [radius, bubbles = std::move(bubbles), is_shared](mesh::Phase phase, const Vec3& x) {
    if (phase > 0) return power_potential(bubbles[phase - 1], x, radius);
    if (is_shared(x)) return -10 * radius;
    double nearest = -1e300;
    for (const auto& bubble : bubbles) nearest = std::max(nearest, power_potential(bubble, x, radius));
    return -nearest;
  };
  return start;
}

/// Power cells that fill the box; the outside is nowhere.
Start lattice_cells(const LatticeShape& lattice, const grid::Box& box) {
  std::vector<LatticeBubble> bubbles = make_lattice(lattice, box);
  const double spacing = lattice_spacing(lattice, box), nowhere = -1e3 * norm(box.size());
  Start start{.target_volume = {0.0}, .potential = {}};
  for (const auto& bubble : bubbles) start.target_volume.push_back(bubble.volume);
  start.potential = [bubbles = std::move(bubbles), domain = box.domain(), spacing, nowhere](mesh::Phase phase,
                                                                                            const Vec3& x) {
    return phase == 0 ? nowhere : lattice_potential(bubbles[phase - 1], x, domain, spacing);
  };
  return start;
}

/// The phases of a labelled image.
Start labelled_phases(const LabelsSource& source, const grid::Box& box) {
  const io::LabelledImage image = load_labels(source, box);
  return {.target_volume = label_volumes(image), .potential = LabelPotentials(image, box)};
}

/// Splits the outside of a start by a film; the part above becomes the last phase.
Start split_outside(Start start, const MembraneShape& membrane) {
  const auto above = static_cast<mesh::Phase>(start.target_volume.size());
  start.target_volume.push_back(0.0);
  start.above_membrane = above;
  const Vec3 normal = normalized(membrane.normal);
  // Each half of the outside falls by twice the depth in the other half, so that half their difference is the
  // distance to the film.
  start.potential = [below = std::move(start.potential), above, normal, point = membrane.point](
                        mesh::Phase phase, const Vec3& x) {
    if (phase != 0 && phase != above) return below(phase, x);
    const double height = dot(normal, x - point);
    return below(0, x) - 2 * std::max(0.0, phase == 0 ? height : -height);
  };
  return start;
}

std::vector<BubbleShape> spheres_of(const LabelsSource& source, const grid::Box& box) {
  const io::LabelledImage image = load_labels(source, box);
  const std::vector<double> volume = label_volumes(image);
  const std::vector<Vec3> centroid = label_centroids(image);
  std::vector<BubbleShape> spheres;
  for (int p = 1; p <= image.n_bubbles(); ++p) {
    const double radius = sphere_radius(volume[p]);
    spheres.push_back({centroid[p], {radius, radius, radius}});
  }
  return spheres;
}

std::vector<BubbleShape> spheres_of(const FilmsSource& source, const InitialFoam& start) {
  const SourcedFilms sourced = load_films(source, start.lamella_half_thickness, start.border_area);
  const std::vector<double> volume = volumes_of(sourced.films);
  std::vector<Vec3> sum(volume.size());
  std::vector<double> count(volume.size(), 0.0);
  for (std::size_t v = 0; v < sourced.films.position.size(); ++v)
    for (mesh::Phase p : sourced.topology.vertex_phases[v]) {
      sum[p] += sourced.films.position[v];
      count[p] += 1;
    }
  std::vector<BubbleShape> spheres;
  for (std::size_t p = 1; p < volume.size(); ++p) {
    if (count[p] == 0) continue;
    const double radius = sphere_radius(volume[p]);
    spheres.push_back({sum[p] / count[p], {radius, radius, radius}});
  }
  return spheres;
}

std::vector<BubbleShape> spheres_of(const LatticeShape& lattice, const grid::Box& box) {
  std::vector<BubbleShape> spheres;
  for (const auto& bubble : make_lattice(lattice, box)) {
    const double radius = sphere_radius(bubble.volume);
    spheres.push_back({bubble.center, {radius, radius, radius}});
  }
  return spheres;
}

}  // namespace

Start start_of(const Case& run_case) {
  if (run_case.foam.lattice) return lattice_cells(*run_case.foam.lattice, run_case.box);
  if (run_case.foam.labels) return labelled_phases(*run_case.foam.labels, run_case.box);
  Start start = power_cells(run_case, bubbles_of(run_case));
  return run_case.foam.membrane ? split_outside(std::move(start), *run_case.foam.membrane) : start;
}

std::vector<BubbleShape> bubbles_of(const Case& run_case) {
  if (run_case.foam.lattice) return spheres_of(*run_case.foam.lattice, run_case.box);
  if (run_case.foam.labels) return spheres_of(*run_case.foam.labels, run_case.box);
  if (run_case.foam.films) return spheres_of(*run_case.foam.films, run_case.foam);
  std::vector<BubbleShape> bubbles = run_case.foam.bubble;
  if (run_case.foam.cluster) {
    const auto cluster = make_cluster(*run_case.foam.cluster, run_case.box);
    bubbles.insert(bubbles.end(), cluster.begin(), cluster.end());
  }
  if (bubbles.empty())
    throw InputError(
        "the case has no bubble: give [[foam.bubble]] entries or a section [foam.cluster], [foam.lattice], "
        "[foam.labels] or [foam.films]");
  check_inside(bubbles, run_case.box);
  return bubbles;
}

}  // namespace spume::simulation
