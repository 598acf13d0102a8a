#pragma once

#include <optional>
#include <span>
#include <vector>

#include "spume/grid/box.hpp"
#include "spume/grid/grid.hpp"
#include "spume/interface/cell_box.hpp"
#include "spume/interface/indicators.hpp"
#include "spume/mesh/phase_set.hpp"
#include "spume/parallel/communicator.hpp"

namespace spume::interface {

/// ψ of one phase [m] at the centres of a block of cells; outside the block the phase is no candidate, and
/// where an interpolation reaches beyond it ψ is `beyond`.
struct PhaseField {
  mesh::Phase phase;
  CellBox cells;
  double beyond;
  std::vector<double> value;
  Lattice lattice{};  ///< PhasePotentials::set() fills it in

  /// Where the value of a cell, or of its image in the block, is stored.
  std::optional<std::size_t> place(int i, int j, int k) const {
    const Index3 c = lattice.image_in(cells, i, j, k);
    if (!cells.contains(c.i, c.j, c.k)) return std::nullopt;
    return cells.offset(c.i, c.j, c.k);
  }
  double at(int i, int j, int k) const {
    const auto n = place(i, j, k);
    return n ? value[*n] : beyond;
  }
};

/// The linearised potentials ψ_i of all phases, the same on every rank. The phase of a point is that of the
/// largest ψ; films are where the two largest are equal. Near a film of phases i and j, ½(ψ_i − ψ_j) is the
/// signed distance.
class PhasePotentials {
 public:
  explicit PhasePotentials(const grid::Box& box) : box_(box), lattice_(lattice_of(box)) {}

  const grid::Box& box() const { return box_; }
  const Lattice& lattice() const { return lattice_; }
  double h() const { return box_.spacing(); }

  /// Adds the field of a phase, or replaces it.
  void set(PhaseField field);
  /// Fields in increasing order of phase.
  const std::vector<PhaseField>& fields() const { return fields_; }
  const PhaseField* find(mesh::Phase phase) const;
  PhaseField* find(mesh::Phase phase);
  /// ψ_phase += amount [m] everywhere: its films move outwards by half of that.
  void raise(mesh::Phase phase, double amount);

  /// ½(ψ_a − ψ_b) at a point by tricubic (Lagrange) interpolation [m], and its gradient [−].
  double difference(const PhaseField& a, const PhaseField& b, const Vec3& x, Vec3& gradient) const;

  /// Newton's method from x onto ψ_i = ψ_j of the given phases: along the gradient for two phases (film), by
  /// the shortest way for three (border), to the point for four or more (junction; the first four decide).
  /// Nothing where gradients are degenerate or the move would be longer than 0.5, 0.8 or 0.5 h.
  std::optional<Vec3> project(const Vec3& x, const mesh::PhaseSet& phases) const;
  /// The sign of det(∇ψ_a − ∇ψ_b, ∇ψ_a − ∇ψ_c, ∇ψ_a − ∇ψ_d) at a point, of the first four phases a < b < c <
  /// d; 0 where one of them has no field. Where the four are equal it is 1 if a, b, c follow each other by
  /// the right-hand rule about the border that they share, seen along it away from the point, and −1 if they
  /// do so in the other order.
  int handedness(const Vec3& x, const mesh::PhaseSet& phases) const;

 private:
  std::optional<Vec3> project_on_film(const Vec3& start, const PhaseField* const* field) const;
  std::optional<Vec3> project_on_border(const Vec3& start, const PhaseField* const* field) const;
  std::optional<Vec3> project_on_junction(const Vec3& start, const PhaseField* const* field) const;

  grid::Box box_;
  Lattice lattice_;
  std::vector<PhaseField> fields_;
  std::vector<int> place_of_phase_;  ///< in fields_; −1: none
};

/// Potentials from smoothed indicators by the profile of a flat film; ψ of the outside from 1 − Σ of all the
/// others. `indicator` of each phase on its
/// `cells` as of smoothed_indicators(); `variance` [m²] and `floor` as of FlatFilmMap.
PhasePotentials potentials_of(const grid::Box& box, std::span<const CellBox> cells,
                              std::vector<std::vector<double>> indicator, double variance, double floor);

/// At every cell the phase with the largest ψ, the lowest of equals. Each rank does its share of the layers
/// of cells and gets the whole. Collective.
std::vector<mesh::Phase> find_winners(const PhasePotentials& potentials,
                                      const parallel::Communicator& ranks = parallel::Communicator::self());
/// At every cell how far the largest ψ is above the second [m]; above the lowest `beyond` where there is but
/// one candidate.
std::vector<double> leads_of_winners(const PhasePotentials& potentials);

}  // namespace spume::interface
