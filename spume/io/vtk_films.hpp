#pragma once

#include <filesystem>
#include <span>

#include "spume/io/column.hpp"
#include "spume/state/film_frame.hpp"

namespace spume::io {

/// The arrays of a films file and what they mean, for the explanation to the user.
std::span<const Column> film_arrays();

/// Writes a frame as VTK poly-data (.vtp, XML, appended, compressed): Plateau borders as poly-lines, then
/// film triangles, with the arrays of film_arrays(). On a point of the other sort a point array holds NaN, on
/// a cell of the other sort a cell array holds −1. The file appears whole or not at all. Throws
/// std::runtime_error when the disk refuses.
void write_films(const state::FilmFrame& frame, const std::filesystem::path& path);

/// Reads back what write_films() wrote, every number bit for bit. Throws InputError when the file is missing,
/// is not poly-data, lacks an array, holds triangle strips, or has a cell with a point that is not there or
/// with a phase that is no number. Passes over cells that are vertices; the time is 0 where none is given.
state::FilmFrame read_films(const std::filesystem::path& path);

}  // namespace spume::io
