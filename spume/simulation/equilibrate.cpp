#include "spume/simulation/equilibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "spume/mesh/measure.hpp"
#include "spume/mesh/remesh.hpp"
#include "spume/mesh/volume_constraint.hpp"
#include "spume/simulation/equilibrium.hpp"
#include "spume/transport/even_stretch.hpp"

namespace spume::simulation {

namespace {

/// The step length: longer while vertices move by little, shorter after a step that raised the area.
class Pace {
 public:
  explicit Pace(double radius) : longest_(radius * radius), tau_(first * longest_) {}
  double tau() const { return tau_; }
  void slow_down() { tau_ *= 0.25; }
  void speed_up() { tau_ = std::min(1.5 * tau_, longest_); }
  bool exhausted() const { return tau_ < 1e-4 * longest_; }
  /// Whether steps are so long that the area they take off tells how much is left.
  bool tells() const { return tau_ >= first * longest_ || exhausted(); }

 private:
  static constexpr double first = 0.1;
  double longest_, tau_;
};

/// Goes ahead of a step by a share of the last move, larger with every step, so that soft modes of a foam,
/// which curvature flow follows slowly, come to rest in few steps (Nesterov's accelerated descent).
class Momentum {
 public:
  /// On another mesh, or after a step that raised the area: the next step starts where the films are.
  void restart() { n_steps_ = 0; }
  /// Moves the vertices on, none by more than `longest` [m]; whether it did.
  bool go_ahead(std::vector<Vec3>& position, double longest) {
    const std::vector<Vec3> here = position;
    const double share = n_steps_ / (n_steps_ + 3.0);
    for (std::size_t v = 0; n_steps_ > 0 && v < position.size(); ++v) {
      const Vec3 move = share * (here[v] - last_[v]);
      position[v] += longest / std::max(norm(move), longest) * move;
    }
    last_ = here;
    return n_steps_++ > 0;
  }

 private:
  int n_steps_ = 0;
  std::vector<Vec3> last_;
};

/// Estimates what the area has still to lose, as if the falls of the last steps went on as a geometric
/// series: by their mean ratio and from the largest of them, for the falls of single steps vary. The first
/// step on a mesh takes off what is rough in it and tells nothing of the rest.
class Remainder {
 public:
  void restart() { n_ = 0; }
  /// `fall` is the relative change of area of a step; gives the sum of all that follow.
  double after(double fall) {
    constexpr double slowest = 0.98, fastest = 0.5;
    std::rotate(fall_.begin(), fall_.end() - 1, fall_.end());
    fall_.front() = fall;
    if (++n_ <= n_falls) return fall * slowest / (1 - slowest);
    const double largest = *std::max_element(fall_.begin(), fall_.end());
    const double ratio =
        fall_.back() > 0 ? std::clamp(std::cbrt(fall / fall_.back()), fastest, slowest) : slowest;
    return largest * ratio / (1 - ratio);
  }

 private:
  static constexpr int n_falls = 4;
  std::array<double, n_falls> fall_{};  // the last first
  int n_ = 0;
};

/// Descent of the area on one mesh after the other.
class Descent {
 public:
  /// `radius` of the mean bubble [m], and how far a vertex may go ahead [m].
  Descent(double radius, double longest_move) : pace_(radius), longest_move_(longest_move) {}

  /// The mesh is another.
  void restart() {
    momentum_.restart();
    remainder_.restart();
    area_.reset();
  }
  /// The next step starts where the films are.
  void stop_going_ahead() { momentum_.restart(); }

  /// One step, and what is left after it; nothing where it would raise the area, and the films stay.
  std::optional<interface::RelaxStepReport> step(mesh::FilmMesh& films, const mesh::Topology& topology,
                                                 const state::Phases& phases) {
    const std::vector<Vec3> before = films.position;
    went_ahead_ = momentum_.go_ahead(films.position, longest_move_);
    auto report = interface::relax_step(films, topology, phases, pace_.tau());
    if (area_) report.area_before = *area_;
    if (report.area_after > report.area_before && (went_ahead_ || !pace_.exhausted())) {
      films.position = before;
      if (!went_ahead_) pace_.slow_down();
      momentum_.restart();
      remainder_.restart();
      return std::nullopt;
    }
    area_ = report.area_after;
    area_change_ = std::abs(report.area_after / report.area_before - 1);
    const double left = remainder_.after(area_change_);
    area_to_fall_ = pace_.tells() ? left : 1;
    if (report.largest_displacement < longest_move_) pace_.speed_up();
    return report;
  }

  bool went_ahead() const { return went_ahead_; }
  double area_change() const { return area_change_; }    ///< relative, of the last step
  double area_to_fall() const { return area_to_fall_; }  ///< relative; 1 where it is not known

 private:
  Pace pace_;
  Momentum momentum_;
  Remainder remainder_;
  double longest_move_;
  std::optional<double> area_;  // after the last step on this mesh
  bool went_ahead_ = false;
  double area_change_ = 1, area_to_fall_ = 1;
};

/// Smallest angle [degrees] and shortest edge [h] of triangles that are good enough.
struct Shape {
  double angle_degrees, edge;
};
constexpr Shape good_in_motion{6, 0.08}, good_at_rest{15, 0.2};

int count_poor_triangles(const mesh::FilmMesh& films, const Shape& good, double h) {
  const double smallest_sine = std::sin(good.angle_degrees * std::numbers::pi / 180);
  int n = 0;
  for (int t = 0; t < films.n_triangles(); ++t) {
    const auto [a, b, c] = films.corners(t);
    std::array<double, 3> side{norm(b - a), norm(c - b), norm(a - c)};
    std::sort(side.begin(), side.end());
    n += side[0] < good.edge * h ||
         norm(mesh::doubled_area_normal(films, t)) < smallest_sine * side[1] * side[2];
  }
  return n;
}

/// Lamellae and borders that are smaller than `length` [m].
int count_vanishing(const mesh::FilmMesh& films, const mesh::Topology& topology, double length) {
  int n = 0;
  for (double area : mesh::lamella_areas(films, topology)) n += area < length * length;
  for (double border : mesh::border_lengths(films, topology)) n += border < length;
  return n;
}

/// What has become of a mesh since it was made. What a remedy leaves counts for nothing: it does not help
/// against that.
class Wear {
 public:
  /// Films shorter than `vanishing` [m] are drawn together by a reconstruction.
  Wear(const std::vector<Vec3>& position, double h, double vanishing)
      : h_(h), vanishing_(vanishing), reference_(position) {}

  /// After a reconstruction, `for_vanishing_films` or for another reason.
  void start(const mesh::FilmMesh& films, const mesh::Topology& topology, bool for_vanishing_films) {
    motion_ = 0;
    reference_ = films.position;
    n_poor_at_rest_ = n_poor_in_motion_ = 0;
    n_vanishing_ = for_vanishing_films ? count_vanishing(films, topology, vanishing_) : 0;
  }
  /// After tidying, which renews the triangles alone.
  void start_triangles(const mesh::FilmMesh& films, double motion) {
    motion_ = motion;
    reference_ = films.position;
    n_poor_at_rest_ = count_poor_triangles(films, good_at_rest, h_);
    n_poor_in_motion_ = count_poor_triangles(films, good_in_motion, h_);
  }

  /// The farthest that a vertex has moved [h].
  double motion(const mesh::FilmMesh& films) const {
    return motion_ + mesh::largest_distance(films.position, reference_) / h_;
  }
  bool has_poor_triangles(const mesh::FilmMesh& films, bool at_rest) const {
    return at_rest ? count_poor_triangles(films, good_at_rest, h_) > n_poor_at_rest_
                   : count_poor_triangles(films, good_in_motion, h_) > n_poor_in_motion_;
  }
  bool has_vanishing_films(const mesh::FilmMesh& films, const mesh::Topology& topology) const {
    return count_vanishing(films, topology, vanishing_) > n_vanishing_;
  }

 private:
  double h_, vanishing_, motion_ = 0;
  std::vector<Vec3> reference_;
  int n_poor_at_rest_ = 0, n_poor_in_motion_ = 0, n_vanishing_ = 0;
};

/// Flips and collapses what has become poor in a mesh, which stays where it is; the liquid goes along. Gives
/// the new topology; none where nothing could be done.
std::optional<mesh::Topology> tidy(const grid::Grid& grid, const Case& run_case,
                                   const mesh::Topology& topology, state::Foam& foam) {
  const double h = grid.h();
  mesh::RemeshParameters parameters = run_case.reconstruct.remesh;
  parameters.merge_below = 0;  // a reconstruction's task
  parameters.collapse_below = 0.4;
  parameters.smoothing_sweeps = 0;
  mesh::FilmMesh films = foam.films;
  const mesh::RemeshReport report = mesh::remesh(
      films, [edge_length = run_case.reconstruct.edge * h](const Vec3&) { return edge_length; },
      [](const Vec3& x, const mesh::PhaseSet&) { return std::optional(x); }, parameters, grid.communicator());
  if (!report.changed()) return std::nullopt;
  mesh::restore_volumes(films, foam.phases.target_volume, 3, 0.1 * h);
  mesh::Topology tidied = mesh::build_topology(films);
  transport::TransferReport transfer;
  replace_films(grid.communicator(), run_case, h, std::move(films), tidied, topology, foam, transfer);
  return tidied;
}

/// Mean length of the edges of a mesh of nearly equal triangles [m].
double mean_edge(const mesh::FilmMesh& films) {
  return std::sqrt(4 / std::sqrt(3.0) * mesh::film_area(films) / std::max(1, films.n_triangles()));
}

/// What a reconstruction without a topological change has added to the area, for the steps that follow to
/// take off again.
class Regain {
 public:
  void start(double area) {
    area_ = area;
    n_left_ = most_steps;
  }
  bool goes_on(double area) {
    if (area <= area_) n_left_ = 0;
    return n_left_-- > 0;
  }

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
  constexpr int most_steps = 2000, most_waits = 40;
  constexpr double largest_step_cells = 0.5, least_motion_cells = 0.5, largest_motion_cells = 1.5;
  constexpr double rest = 1e-5, largest_virial_error = 1e-4;
  const double h = grid.h();
  // Flat triangles have too much area for their volumes, by the square of their edges: the films come to rest
  // on the ordinary mesh, and once more on a finer one.
  Case fine_case = run_case;
  fine_case.reconstruct.edge = 0.65;
  fine_case.reconstruct.remesh.split_above = 1.25;
  fine_case.reconstruct.remesh.merge_below /= fine_case.reconstruct.edge;
  const bool came_fine = mean_edge(foam.films) < 0.8 * h;
  bool is_fine = false;
  const double vanishing = run_case.reconstruct.remesh.merge_below * run_case.reconstruct.edge * h;
  Descent descent(mean_bubble_radius(foam.phases), largest_step_cells * h);
  Regain regain;

  EquilibrateReport report;
  if (foam.films.triangle.empty()) {
    report = {.virial_error = 0, .area_change = 0, .area_to_fall = 0, .converged = true};
    return report;
  }
  // A step restores the volumes, and could not lower the area of films that hold too little.
  mesh::restore_volumes(foam.films, foam.phases.target_volume, 3, 0.1 * h);
  mesh::Topology topology = mesh::build_topology(foam.films);
  Wear wear(foam.films.position, h, vanishing);
  int n_waits = 0;
  while (report.n_steps < most_steps) {
    const mesh::FilmMesh before = foam.films;
    const auto step = descent.step(foam.films, topology, foam.phases);
    if (!step) continue;
    transport::stretch_evenly(before, foam.films, topology, foam.liquid);
    ++report.n_steps;
    report.virial_error = step->virial_error;
    report.area_change = descent.area_change();
    report.area_to_fall = descent.area_to_fall();
    if (regain.goes_on(step->area_after)) continue;
    if (!on_step(*step, topology)) break;

    const double motion = wear.motion(foam.films);
    const bool at_rest = report.area_to_fall < rest && report.virial_error < largest_virial_error;
    const bool poor = wear.has_poor_triangles(foam.films, at_rest);
    const bool has_vanishing =
        (at_rest || motion > least_motion_cells) && wear.has_vanishing_films(foam.films, topology);
    if (motion < largest_motion_cells && !at_rest && !poor && !has_vanishing) continue;
    const bool on_fine_mesh = is_fine || (came_fine && report.n_reconstructions == 0);
    if (at_rest && on_fine_mesh && !poor && !has_vanishing) {
      // A film that is left too small by a reconstruction of a mesh at rest grows, slowly at first.
      if (n_waits < most_waits && count_vanishing(foam.films, topology, vanishing) > 0) {
        ++n_waits;
        continue;
      }
      // The virial identity was measured where the step started, which may be ahead of the films.
      report.converged = !descent.went_ahead();
      if (report.converged) break;
      descent.stop_going_ahead();
      continue;
    }

    if (poor && !has_vanishing && motion < largest_motion_cells) {
      if (auto tidied = tidy(grid, on_fine_mesh ? fine_case : run_case, topology, foam)) {
        topology = std::move(*tidied);
        descent.restart();
      }
      wear.start_triangles(foam.films, motion);
      continue;
    }
    descent.restart();
    is_fine = is_fine || (at_rest && !has_vanishing);
    FilmUpdate update = reconstruct_films(grid, is_fine ? fine_case : run_case, topology, foam);
    ++report.n_reconstructions;
    events.insert(events.end(), update.events.begin(), update.events.end());
    topology = std::move(update.topology);
    wear.start(foam.films, topology, has_vanishing);
    if (update.events.empty()) regain.start(step->area_after);
  }
  transport::fill_young_films(foam.films, topology, foam.liquid, h, run_case.transport);
  return report;
}

}  // namespace spume::simulation
