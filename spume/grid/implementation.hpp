#pragma once

#include <petscdmda.h>

#include <map>
#include <memory>

#include "spume/grid/field.hpp"
#include "spume/grid/grid.hpp"
#include "spume/grid/transform.hpp"
#include "spume/parallel/petsc.hpp"

// Internal to grid/: brings PETSc's headers.
namespace spume::grid {

/// A DMDA with `width` layers of ghosts, and the two vectors without storage through which it moves the
/// values of fields.
struct GhostExchange {
  parallel::PetscOwner<DM, DMDestroy> dm;
  parallel::PetscOwner<Vec, VecDestroy> owned;    ///< global vector: PETSc's ordering is that of Field
  parallel::PetscOwner<Vec, VecDestroy> ghosted;  ///< local vector: the layout of exchange_ghosts()
};

/// What a grid makes once and its fields, filters and solvers share; made at first use.
struct Grid::Implementation {
  std::map<int, GhostExchange> exchange_of_width;
  std::map<Symmetry, std::unique_ptr<Transform>> transform_of_symmetry;
};

/// The DMDA of `grid` for ghosts of `width` layers. Collective at first use of a width.
GhostExchange& ghost_exchange(const Grid& grid, int width);

/// `symmetry` with Even in the directions where it has no effect, so that equal behaviour has equal keys.
Symmetry effective_symmetry(const Box& box, Symmetry symmetry);

/// The transform of fields on `grid` with `symmetry`. Collective at first use of a symmetry.
Transform& transform_of(const Grid& grid, const Symmetry& symmetry);

}  // namespace spume::grid
