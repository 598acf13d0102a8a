#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <vector>

#include "spume/grid/box.hpp"
#include "spume/io/column.hpp"
#include "spume/mesh/phase_set.hpp"

namespace spume::io {

/// What a gas file holds: values at all cell centres of the box, i fastest, then j, k; empty ones are left
/// out.
struct GasFrame {
  double time = 0;                              ///< [s]
  std::array<std::vector<double>, 3> velocity;  ///< [m/s]
  std::vector<double> pressure;                 ///< [Pa]
  std::vector<mesh::Phase> phase;
  std::vector<double> distance;  ///< to the nearest film [m]
};

/// The arrays of a gas file and what they mean, for the explanation to the user.
std::span<const Column> gas_arrays();

/// Writes the frame as a VTK image (.vti, XML, appended, compressed) with cell data, numbers in single
/// precision. The file appears whole or not at all. For one rank. Throws std::runtime_error when the disk
/// refuses.
void write_gas(const GasFrame& frame, const grid::Box& box, const std::filesystem::path& path);

}  // namespace spume::io
