#pragma once

#include <map>
#include <memory>

#include "spume/grid/field.hpp"
#include "spume/grid/grid.hpp"
#include "spume/grid/transform.hpp"

// Internal to grid/: brings FFTW's header.
namespace spume::grid {

/// What a grid makes once and its fields, filters and solvers share; made at first use.
struct Grid::Implementation {
  std::map<Symmetry, std::unique_ptr<Transform>> transform_of_symmetry;
};

/// `symmetry` with Even in the directions where it has no effect, so that equal behaviour has equal keys.
Symmetry effective_symmetry(const Box& box, Symmetry symmetry);

/// The transform of fields on `grid` with `symmetry`. Collective at first use of a symmetry.
Transform& transform_of(const Grid& grid, const Symmetry& symmetry);

}  // namespace spume::grid
