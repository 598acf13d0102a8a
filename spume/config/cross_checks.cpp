#include "spume/config/cross_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spume::config {

namespace {

using simulation::Case;

constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

/// Films must stay this many cells from the edge of the box.
constexpr int margin_cells = 4;

bool check_box(const Case& run_case, const Entries& entries, Problems& problems) {
  const grid::Box& box = run_case.box;
  for (int axis = 0; axis < 3; ++axis) {
    if (box.upper[axis] > box.lower[axis]) continue;
    problems.add(entries.place_of("domain.upper"),
                 fmt::format("'domain.upper' must be larger than 'domain.lower' along {}: {} m and {} m",
                             axis_names[axis], box.upper[axis], box.lower[axis]));
    return false;
  }
  Vec3 spacing;
  for (int axis = 0; axis < 3; ++axis) spacing[axis] = box.size()[axis] / box.cells[axis];
  // Decimal fractions of a metre are rounded at 1e-16; a difference that a user can mean is much larger than
  // 1e-9.
  constexpr double rounding = 1e-9;
  const double largest = std::max({spacing.x, spacing.y, spacing.z});
  const double smallest = std::min({spacing.x, spacing.y, spacing.z});
  if (largest - smallest <= rounding * largest) return true;
  problems.add(entries.place_of("domain.cells"),
               fmt::format("cells must be cubes; they are {:.6g} × {:.6g} × {:.6g} m along x, y, z: change "
                           "'domain.cells' or the corners of the box",
                           spacing.x, spacing.y, spacing.z));
  return false;
}

void check_bubble_inside(const grid::Box& box, const simulation::BubbleShape& bubble,
                         const std::string& which, const Place& place, Problems& problems) {
  const double margin = margin_cells * box.spacing();
  for (int axis = 0; axis < 3; ++axis) {
    const double low = bubble.center[axis] - bubble.semi_axes[axis];
    const double high = bubble.center[axis] + bubble.semi_axes[axis];
    if (low >= box.lower[axis] + margin && high <= box.upper[axis] - margin) continue;
    problems.add(place,
                 fmt::format("{} reaches from {:.6g} to {:.6g} m along {}; it must stay {} cells inside the "
                             "box, between {:.6g} and {:.6g} m",
                             which, low, high, axis_names[axis], margin_cells, box.lower[axis] + margin,
                             box.upper[axis] - margin));
  }
}

/// A resolved case states all keys; those of the other structure may not differ from their defaults.
void check_lattice_keys(const simulation::LatticeShape& lattice, const Entries& entries, Problems& problems) {
  const simulation::LatticeShape standard;
  const bool random = lattice.structure == simulation::LatticeShape::Structure::Random;
  const auto refuse = [&](const char* key, bool differs, const char* owner) {
    if (differs)
      problems.add(
          entries.place_of(fmt::format("foam.lattice.{}", key)),
          fmt::format("'foam.lattice.{}' has no effect here: it belongs to structure = {}", key, owner));
  };
  if (random) {
    refuse("cells", lattice.cells != standard.cells, "\"kelvin\" or \"weaire-phelan\"");
    return;
  }
  refuse("count", lattice.count != standard.count, "\"random\"");
  refuse("spread", lattice.spread != standard.spread, "\"random\"");
  refuse("seed", lattice.seed != standard.seed, "\"random\"");
}

void check_lattice(const Case& run_case, const Entries& entries, Problems& problems) {
  using Structure = simulation::LatticeShape::Structure;
  const simulation::LatticeShape& lattice = *run_case.foam.lattice;
  const grid::Box& box = run_case.box;
  const Place place = entries.place_of("foam.lattice");
  if (!box.is_periodic())
    problems.add(entries.place_of("domain.boundary"),
                 "[foam.lattice] needs a box that is periodic in all three directions");
  check_lattice_keys(lattice, entries, problems);
  if (lattice.structure != Structure::Random) {
    const Vec3 cells = simulation::crystal_cells(lattice, box);
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(cells[axis] - std::round(cells[axis])) > 1e-6)
        problems.add(
            entries.place_of("foam.lattice.cells"),
            fmt::format("the crystal does not fit the box: {:.6g} cubic cells along {}; sides must be "
                        "whole multiples of a cell",
                        cells[axis], axis_names[axis]));
    if (lattice.structure == Structure::Kelvin && lattice.cells < 2)
      problems.add(
          entries.place_of("foam.lattice.cells"),
          "'foam.lattice.cells' must be ≥ 2 for \"kelvin\": in a single cell every bubble would touch "
          "its own image");
  }
  constexpr double fewest_cells = 4;
  const double edge = simulation::lattice_spacing(lattice, box) / box.spacing();
  if (edge < fewest_cells)
    problems.add(place,
                 fmt::format("{} bubbles are too many for this grid: each fills a cube of {:.2g} cells "
                             "edge; the least is {}",
                             simulation::count_bubbles(lattice, box), edge, fewest_cells));
}

void check_membrane(const Case& run_case, const Entries& entries, Problems& problems) {
  const simulation::MembraneShape& membrane = *run_case.foam.membrane;
  const grid::Box& box = run_case.box;
  const Vec3& n = membrane.normal;
  int across = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(n[axis]) > std::abs(n[across])) across = axis;
  for (int axis = 0; axis < 3; ++axis)
    if (n[across] == 0 || (axis != across && n[axis] != 0)) {
      problems.add(
          entries.place_of("foam.membrane.normal"),
          fmt::format("'foam.membrane.normal' must be along x, y or z, not [{}, {}, {}]: other films "
                      "would not close on themselves",
                      n.x, n.y, n.z));
      return;
    }
  for (int axis = 0; axis < 3; ++axis) {
    const bool periodic = box.boundary[axis] == grid::Boundary::Periodic;
    if (axis == across && periodic)
      problems.add(
          entries.place_of("domain.boundary"),
          fmt::format("[foam.membrane] lies across {}: there the box needs \"wall\" or \"slip\", or the "
                      "gas above would be that below",
                      axis_names[axis]));
    if (axis != across && !periodic)
      problems.add(entries.place_of("domain.boundary"),
                   fmt::format("[foam.membrane] would meet a wall across {}, which is not supported: the box "
                               "must be periodic there",
                               axis_names[axis]));
  }
  for (int axis = 0; axis < 3; ++axis)
    if (axis != across && run_case.materials.gravity[axis] != 0)
      problems.add(entries.place_of("gravity"),
                   fmt::format("'gravity' along {} would drive liquid around the membrane for ever: with "
                               "[foam.membrane] it must be along {}",
                               axis_names[axis], axis_names[across]));
  const double low = box.lower[across] + margin_cells * box.spacing();
  const double high = box.upper[across] - margin_cells * box.spacing();
  if (membrane.point[across] < low || membrane.point[across] > high)
    problems.add(entries.place_of("foam.membrane.point"),
                 fmt::format("[foam.membrane] lies at {} = {:.6g} m; it must stay {} cells inside the box, "
                             "between {:.6g} and {:.6g} m",
                             axis_names[across], membrane.point[across], margin_cells, low, high));
}

/// Films of a file only drain: no potentials of phases stand behind them, and no grid.
void check_films(const Case& run_case, const Entries& entries, Problems& problems) {
  const auto& foam = run_case.foam;
  if (foam.films->file.empty())
    problems.add(entries.place_of("foam.films"), "[foam.films] has no 'file' (the films)");
  if (!foam.bubble.empty() || foam.cluster || foam.lattice || foam.labels || foam.membrane)
    problems.add(entries.place_of("foam.films"),
                 "[foam.films] gives all films: no bubbles, lattice, labels or membrane can be given");
  if (run_case.cycle.stages != std::vector{simulation::Stage::Drain})
    problems.add(entries.place_of("cycle.stages"),
                 "[foam.films] has films without a grid: they can only drain, 'cycle.stages' must be "
                 "[\"drain\"]");
  if (foam.equilibrate || !foam.remove_lamella.empty())
    problems.add(entries.place_of("foam"),
                 "[foam.films] are drained as they are: no 'equilibrate' and no 'remove_lamella'");
  for (const auto boundary : run_case.box.boundary)
    if (boundary == grid::Boundary::Periodic) {
      problems.add(
          entries.place_of("domain.boundary"),
          "[foam.films] do not go on through periodic faces: leave [domain] out, or make it \"wall\"");
      return;
    }
}

/// Edges far below a cell would make meshes that no machine holds; those beyond a cell have no effect.
void check_edges(const Case& run_case, const Entries& entries, Problems& problems) {
  constexpr double finest = 50;  // parts of a cell
  const double h = run_case.box.spacing();
  const double at_borders = run_case.meshing.edge_at_borders,
               at_junctions = run_case.meshing.edge_at_junctions;
  const auto check = [&](const char* key, double edge) {
    if (edge == 0) return;
    if (run_case.foam.films)
      problems.add(entries.place_of(key),
                   fmt::format("'{}' has no effect here: films of a file are not meshed", key));
    else if (edge < h / finest || edge > h)
      problems.add(entries.place_of(key),
                   fmt::format("'{}' must be 0 or from {:.3g} to {:.3g} m, 1/{} of a cell of the grid to a "
                               "whole one, not {}",
                               key, h / finest, h, finest, edge));
  };
  check("drainage.edge_at_borders", at_borders);
  check("drainage.edge_at_junctions", at_junctions);
  if (at_borders > 0 && at_junctions > at_borders)
    problems.add(
        entries.place_of("drainage.edge_at_junctions"),
        fmt::format("'drainage.edge_at_junctions' must be ≤ 'drainage.edge_at_borders', {} m, not {}",
                    at_borders, at_junctions));
}

/// A foam starts in one way; a membrane goes with bubbles of a list or cluster.
void check_one_start(const Case& run_case, const Entries& entries, Problems& problems) {
  const auto& foam = run_case.foam;
  if (foam.films) return check_films(run_case, entries, problems);
  const bool has_bubbles = !foam.bubble.empty() || foam.cluster;
  if (!has_bubbles && !foam.lattice && !foam.labels)
    problems.add(
        entries.place_of("foam.bubble"),
        "no bubbles: give [[foam.bubble]], [foam.cluster], [foam.lattice], [foam.labels] or [foam.films]");
  const bool others = has_bubbles || foam.membrane;
  if (foam.lattice && (others || foam.labels))
    problems.add(entries.place_of("foam.lattice"),
                 "[foam.lattice] fills the box: no other bubbles, labels or membrane can be given");
  else if (foam.labels && others)
    problems.add(entries.place_of("foam.labels"),
                 "[foam.labels] gives the whole foam: no other bubbles or membrane can be given");
  if (foam.labels && foam.labels->file.empty())
    problems.add(entries.place_of("foam.labels"), "[foam.labels] has no 'file' (the labelled image)");
}

void check_bubbles(const Case& run_case, const Entries& entries, const std::vector<Place>& places,
                   Problems& problems) {
  const auto& bubbles = run_case.foam.bubble;
  if (run_case.foam.lattice) check_lattice(run_case, entries, problems);
  if (run_case.foam.membrane) check_membrane(run_case, entries, problems);
  check_one_start(run_case, entries, problems);
  for (std::size_t b = 0; b < bubbles.size(); ++b)
    check_bubble_inside(run_case.box, bubbles[b], fmt::format("bubble {}", b + 1), places[b], problems);
}

void check_pairs(const std::vector<std::array<int, 2>>& pairs, const std::string& name, int n_bubbles,
                 const Place& place, Problems& problems) {
  for (const auto& [a, b] : pairs) {
    if (a == b)
      problems.add(place, fmt::format("'{}': no film is between phase {} and itself", name, a));
    else if (std::max(a, b) > n_bubbles)
      problems.add(place, fmt::format("'{}': there is no phase {}; the phases are 0 (outside) to {}", name,
                                      std::max(a, b), n_bubbles));
  }
}

}  // namespace

void cross_check(const Case& run_case, const Entries& entries, const std::vector<Place>& bubble_places,
                 Problems& problems) {
  if (check_box(run_case, entries, problems)) {
    check_bubbles(run_case, entries, bubble_places, problems);
    check_edges(run_case, entries, problems);
  }
  using Interface = simulation::RearrangementParameters::Interface;
  if (run_case.rearrangement.interface == Interface::Viim &&
      (run_case.foam.lattice || run_case.foam.membrane))
    problems.add(entries.place_of("rearrangement.interface"),
                 "\"viim\" needs films that stay four cells away from every face of the box: not a "
                 "[foam.lattice] or a [foam.membrane]; use \"mesh\"");
  if (run_case.foam.labels || run_case.foam.films) return;  // only the file tells how many phases there are
  const auto& foam = run_case.foam;
  const int n_bubbles = static_cast<int>(foam.bubble.size()) + (foam.cluster ? foam.cluster->count : 0) +
                        (foam.lattice ? simulation::count_bubbles(*foam.lattice, run_case.box) : 0) +
                        (foam.membrane ? 1 : 0);
  check_pairs(run_case.foam.remove_lamella, "foam.remove_lamella", n_bubbles,
              entries.place_of("foam.remove_lamella"), problems);
  check_pairs(run_case.rupture.protect, "rupture.protect", n_bubbles, entries.place_of("rupture.protect"),
              problems);
}

}  // namespace spume::config
