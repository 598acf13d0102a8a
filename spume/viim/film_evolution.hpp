#pragma once

#include <vector>

#include "spume/grid/field.hpp"
#include "spume/grid/grid.hpp"
#include "spume/grid/kernel_coupling.hpp"
#include "spume/interface/reconstruct.hpp"
#include "spume/mesh/film_mesh.hpp"
#include "spume/state/phases.hpp"
#include "spume/viim/distance_field.hpp"

namespace spume::viim {

struct Parameters {
  double epsilon = 1.5;             ///< ε, the level whose Voronoi interface is taken [h]
  int rebuild_interval = 50;        ///< k_reinit, steps between rebuilds of φ, at most
  double rebuild_displacement = 1;  ///< φ is rebuilt when a film may have moved as far [h]
};

/// The Voronoi Implicit Interface Method of the paper (Sec. 3.1): φ and χ are what moves. Each step φ is
/// advanced with the extension velocity, the Voronoi interface of its ε-level sets is contoured into a
/// conforming film mesh, and χ becomes the phase of the nearest level set; φ itself is rebuilt from the
/// Voronoi interface every few steps. Work is replicated: the same on every rank.
class FilmEvolution {
 public:
  /// φ of `films`, `phase_of_cell` χ (i fastest, then j, k). `grid` must outlive the evolution.
  FilmEvolution(const grid::Grid& grid, const Parameters& parameters, const mesh::FilmMesh& films,
                std::vector<mesh::Phase> phase_of_cell);

  /// One step of dt [s] with the gas. `films` are those of the last step (or of the start). Changes of
  /// `phases` are as of interface::reconstruct(); a bubble without a cell of φ > ε is lost. Collective;
  /// throws NumericalError when a film comes within four cells of the edge of the box.
  interface::Reconstruction move(const mesh::FilmMesh& films, state::Phases& phases,
                                 const grid::VectorField& velocity, const grid::KernelCoupling& kernel,
                                 double dt, const interface::ReconstructParameters& parameters);

  const DistanceField& field() const { return field_; }

 private:
  bool remove_lost_bubbles(const mesh::FilmMesh& films, state::Phases& phases,
                           std::vector<interface::ReconstructReport::PhaseChange>& changes);
  bool relabel(const interface::PhasePotentials& potentials);

  const grid::Grid& grid_;
  Parameters parameters_;
  DistanceField field_;
  int steps_ = 0;            ///< since φ was rebuilt
  double displacement_ = 0;  ///< of films since then, at most [m]
};

}  // namespace spume::viim
