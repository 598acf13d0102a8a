#pragma once

#include <span>
#include <string>

#include "spume/io/column.hpp"

namespace spume::simulation {

/// The columns of the tables of the output folder, in their order.
std::span<const io::Column> history_columns();
std::span<const io::Column> bubble_columns();
std::span<const io::Column> lamella_columns();
std::span<const io::Column> border_columns();
std::span<const io::Column> event_columns();

/// The text of README.txt of an output folder: every file and column, from the lists that the writers use.
std::string explain_output();

}  // namespace spume::simulation
