#include "spume/simulation/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "spume/mesh/phase_frames.hpp"

namespace spume::simulation {

double mean_bubble_radius(const state::Phases& phases) {
  double volume = 0;
  for (mesh::Phase p = 1; p < phases.count(); ++p)
    if (phases.is_bubble(p)) volume += phases.target_volume[p];
  return std::cbrt(volume / std::max(1, phases.n_bubbles()) * 3 / (4 * std::numbers::pi));
}

double equilibrium_window(const state::Phases& phases, const state::Materials& materials) {
  const double radius = mean_bubble_radius(phases);
  return 3 *
         std::sqrt(materials.gas.density * radius * radius * radius / (2 * materials.film.surface_tension));
}

double virial_ratio(const mesh::FilmMesh& films, const state::Phases& phases,
                    std::span<const double> pressure, double film_area, double surface_tension) {
  if (!mesh::stands_free(films, phases.count())) return 1;
  double work = 0;
  for (int p = 1; p < phases.count(); ++p) work += pressure[p] * phases.target_volume[p];
  return work / (2.0 / 3 * 2 * surface_tension * film_area);
}

EquilibriumMeasure measure_equilibrium(RearrangeState& rearrange, double window, double kinetic_energy,
                                       double film_area, double virial, double surface_tension) {
  auto& time = rearrange.recent_time;
  time.push_back(rearrange.elapsed);
  rearrange.recent_kinetic_energy.push_back(kinetic_energy);
  rearrange.recent_area.push_back(film_area);
  rearrange.recent_virial.push_back(virial);
  const auto old =
      std::find_if(time.begin(), time.end(), [&](double t) { return t > rearrange.elapsed - window; });
  const std::ptrdiff_t n_old = std::max<std::ptrdiff_t>(0, old - time.begin() - 1);
  for (auto* list : {&rearrange.recent_time, &rearrange.recent_kinetic_energy, &rearrange.recent_area,
                     &rearrange.recent_virial})
    list->erase(list->begin(), list->begin() + n_old);

  EquilibriumMeasure measure;
  measure.window_full = time.back() - time.front() >= window;
  const double energy =
      *std::max_element(rearrange.recent_kinetic_energy.begin(), rearrange.recent_kinetic_energy.end());
  measure.amplitude = std::sqrt(energy / (2 * surface_tension * film_area));
  measure.area_change = std::abs(rearrange.recent_area.front() / film_area - 1);
  const auto& ratios = rearrange.recent_virial;
  measure.virial_error =
      std::abs(std::accumulate(ratios.begin(), ratios.end(), 0.0) / static_cast<double>(ratios.size()) - 1);
  return measure;
}

}  // namespace spume::simulation
