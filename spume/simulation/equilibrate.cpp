#include "spume/simulation/equilibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "spume/mesh/measure.hpp"
#include "spume/mesh/quality.hpp"
#include "spume/simulation/equilibrium.hpp"

namespace spume::simulation {

namespace {

/// The step length: longer while steps are small and the area falls, shorter after a step that raised it.
class Pace {
 public:
  explicit Pace(double radius) : longest_(0.5 * radius * radius), tau_(0.05 * radius * radius) {}
  double tau() const { return tau_; }
  void restart() { tau_ = 0.1 * longest_; }
  void slow_down() { tau_ *= 0.25; }
  void speed_up() { tau_ = std::min(1.5 * tau_, longest_); }
  bool exhausted() const { return tau_ < 1e-4 * longest_; }

 private:
  double longest_, tau_;
};

/// Estimates what the area has still to lose: steps of one length shorten it by a falling geometric series.
class Remainder {
 public:
  void restart() { last_ = 0; }
  /// `fall` is the relative change of area of a step; gives the sum of all that follow.
  double after(double fall) {
    const double ratio = last_ > 0 ? std::clamp(fall / last_, 0.0, 0.98) : 0.98;
    last_ = fall;
    return fall * ratio / (1 - ratio);
  }

 private:
  double last_ = 0;
};

bool has_poor_triangles(const mesh::FilmMesh& films, const mesh::Topology& topology, double h) {
  const mesh::Quality quality = mesh::measure_quality(films, topology);
  return quality.shortest_edge < 0.2 * h || quality.smallest_angle_degrees < 15;
}

/// What a reconstruction without a topological change has added to the area, for the steps that follow to
/// take off again.
class Regain {
 public:
  void start(double area) {
    area_ = area;
    n_left_ = most_steps;
  }
  bool goes_on(double area) { return area > area_ && n_left_-- > 0; }

 private:
  static constexpr int most_steps = 10;
  double area_ = 0;
  int n_left_ = 0;
};

}  // namespace

std::string virial_text(const EquilibrateReport& report) {
  if (report.virial_error == 0) return "no outer pressure for the virial identity";
  return fmt::format("virial identity off by {:.2g}", report.virial_error);
}

EquilibrateReport equilibrate(const grid::Grid& grid, const Case& run_case, state::Foam& foam,
                              std::vector<state::Event>& events, const OnRelaxStep& on_step) {
  constexpr int most_steps = 2000;
  constexpr double largest_motion_cells = 0.5;
  constexpr double rest = 1e-5, largest_virial_error = 1e-4;
  const double h = grid.h();
  // Flat triangles have too much area for their volumes, by the square of their edges: the films come to rest
  // on the ordinary mesh, and once more on a finer one.
  Case fine_case = run_case;
  fine_case.reconstruct.edge = 0.65;
  fine_case.reconstruct.remesh.split_above = 1.25;
  bool is_fine = false;
  Pace pace(mean_bubble_radius(foam.phases));
  Remainder remainder;
  Regain regain;

  EquilibrateReport report;
  mesh::Topology topology = mesh::build_topology(foam.films);
  std::vector<Vec3> reference = foam.films.position;
  bool stays_poor = false;  // reconstructing does not help
  while (report.n_steps < most_steps) {
    const std::vector<Vec3> before = foam.films.position;
    const auto step = interface::relax_step(foam.films, topology, foam.phases, pace.tau());
    if (step.area_after > step.area_before && !pace.exhausted()) {
      foam.films.position = before;
      pace.slow_down();
      remainder.restart();
      continue;
    }
    ++report.n_steps;
    report.virial_error = step.virial_error;
    report.area_change = std::abs(step.area_after / step.area_before - 1);
    report.area_to_fall = remainder.after(report.area_change);
    if (step.largest_displacement < 0.1 * h) pace.speed_up();
    if (regain.goes_on(step.area_after)) continue;
    if (!on_step(step, topology)) break;

    const double motion = mesh::largest_distance(foam.films.position, reference) / h;
    const bool at_rest = report.area_to_fall < rest && report.virial_error < largest_virial_error;
    const bool poor = !stays_poor && has_poor_triangles(foam.films, topology, h);
    report.converged = is_fine && at_rest && !poor;
    if (report.converged) break;
    if (motion < largest_motion_cells && !at_rest && !poor) continue;

    is_fine = is_fine || (at_rest && !poor);
    FilmUpdate update = reconstruct_films(grid, is_fine ? fine_case : run_case, topology, foam);
    ++report.n_reconstructions;
    events.insert(events.end(), update.events.begin(), update.events.end());
    topology = std::move(update.topology);
    reference = foam.films.position;
    pace.restart();
    remainder.restart();
    if (update.events.empty()) regain.start(step.area_after);
    stays_poor = has_poor_triangles(foam.films, topology, h);
  }
  return report;
}

}  // namespace spume::simulation
