#pragma once

#include <string>

#include "spume/state/film_network.hpp"

namespace spume::drainage {

/// "(x, y, z) m", for messages.
std::string place_text(const Vec3& x);

/// A film dof in words: its lamella's phases, its kind of vertex, its η and where it is.
std::string describe_film_dof(const state::FilmNetwork& network, int film_dof, double eta);

/// A border vertex in words: whether it is a junction, its λ and where it is.
std::string describe_border_vertex(const state::FilmNetwork& network, int vertex, double lambda);

/// Throws NumericalError that says what and where.
[[noreturn]] void throw_at(const std::string& what, const Vec3& x);

}  // namespace spume::drainage
