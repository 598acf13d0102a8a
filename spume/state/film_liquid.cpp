#include "spume/state/film_liquid.hpp"

#include <numeric>

namespace spume::state {

double FilmLiquid::in_lamellae() const {
  return std::accumulate(lamella_volume.begin(), lamella_volume.end(), 0.0);
}
double FilmLiquid::in_borders() const {
  return std::accumulate(border_volume.begin(), border_volume.end(), 0.0);
}

}  // namespace spume::state
