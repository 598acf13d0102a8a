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

void check_lattice(const Case& run_case, const Entries& entries, Problems& problems) {
  using Structure = simulation::LatticeShape::Structure;
  const simulation::LatticeShape& lattice = *run_case.foam.lattice;
  const grid::Box& box = run_case.box;
  const Place place = entries.place_of("foam.lattice");
  if (!run_case.foam.bubble.empty() || run_case.foam.cluster)
    problems.add(place,
                 "[foam.lattice] fills the box: there is no room for [[foam.bubble]] or [foam.cluster]");
  if (!box.is_periodic())
    problems.add(entries.place_of("domain.boundary"),
                 "[foam.lattice] needs a box that is periodic in all three directions");
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

void check_bubbles(const Case& run_case, const Entries& entries, const std::vector<Place>& places,
                   Problems& problems) {
  const auto& bubbles = run_case.foam.bubble;
  if (run_case.foam.lattice) check_lattice(run_case, entries, problems);
  if (bubbles.empty() && !run_case.foam.cluster && !run_case.foam.lattice)
    problems.add(entries.place_of("foam.bubble"),
                 "no bubbles: give [[foam.bubble]], [foam.cluster] or [foam.lattice]");
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
  if (check_box(run_case, entries, problems)) check_bubbles(run_case, entries, bubble_places, problems);
  const int n_bubbles =
      static_cast<int>(run_case.foam.bubble.size()) +
      (run_case.foam.cluster ? run_case.foam.cluster->count : 0) +
      (run_case.foam.lattice ? simulation::count_bubbles(*run_case.foam.lattice, run_case.box) : 0);
  check_pairs(run_case.foam.remove_lamella, "foam.remove_lamella", n_bubbles,
              entries.place_of("foam.remove_lamella"), problems);
  check_pairs(run_case.rupture.protect, "rupture.protect", n_bubbles, entries.place_of("rupture.protect"),
              problems);
}

}  // namespace spume::config
