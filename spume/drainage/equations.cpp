#include "spume/drainage/equations.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace spume::drainage {

DrainageEquations::DrainageEquations(const state::FilmNetwork& network, const state::Materials& materials,
                                     const parallel::Communicator& communicator)
    : materials_(materials),
      shares_(network.topology, communicator),
      borders_(build_border_network(network, materials.gravity)),
      sites_(suction_sites(network, borders_)),
      film_area_(network.topology.film_dof.size(), 0.0) {
  communicator.together([&] {
    for (LamellaDomain& domain : build_lamella_domains(network, materials.gravity, sites_, shares_.own())) {
      for (int i = 0; i < domain.size(); ++i) film_area_[domain.film_dof[i]] = domain.surface.mass[i];
      const std::vector<double> zero(domain.size(), 0.0);
      LamellaJacobian jacobian(domain);
      fem::LaggedLu lu(jacobian.column_offset(), jacobian.row());
      std::vector<double> weight;
      for (double area : domain.surface.mass) weight.push_back(1 / area);
      lamellae_.push_back(
          {std::move(domain), std::move(jacobian), std::move(lu), std::move(weight), zero, zero, zero});
    }
    build_border_system();
  });
  shares_.exchange(film_area_);
}

DrainageEquations::DrainageEquations(BorderNetwork borders, const state::Materials& materials)
    : materials_(materials), shares_({}, parallel::Communicator::self()), borders_(std::move(borders)) {
  build_border_system();
}

Unknowns DrainageEquations::read(const state::FilmNetwork& network) const {
  Unknowns y{network.half_thickness, {}};
  for (int v : borders_.vertex) y.border.push_back(network.border_area[v]);
  return y;
}

void DrainageEquations::write(const Unknowns& y, state::FilmNetwork& network) const {
  network.half_thickness = y.film;
  for (int u = 0; u < borders_.size(); ++u) network.border_area[borders_.vertex[u]] = y.border[u];
}

double DrainageEquations::liquid(const Unknowns& y) const {
  long double sum = 0;  // so that what the ledger shows is the scheme and not the summation
  for (std::size_t d = 0; d < y.film.size(); ++d) sum += 2.0L * film_area_[d] * y.film[d];
  for (std::size_t u = 0; u < y.border.size(); ++u)
    sum += static_cast<long double>(borders_.length[u]) * y.border[u];
  return static_cast<double>(sum);
}

void DrainageEquations::gather(const Unknowns& y, LamellaSystem& lamella) const {
  for (int i = 0; i < lamella.domain.size(); ++i) lamella.eta[i] = y.film[lamella.domain.film_dof[i]];
  lamella_potential(lamella.domain, lamella.eta, materials_, lamella.potential);
}

void DrainageEquations::evaluate_film_rates(const Unknowns& y, const Suction& suction, Unknowns& rate) {
  rate.film.assign(y.film.size(), 0.0);
  for (LamellaSystem& lamella : lamellae_) {
    gather(y, lamella);
    std::fill(lamella.balance.begin(), lamella.balance.end(), 0.0);
    add_lamella_flow(lamella.domain, lamella.eta, lamella.potential, lamella.balance);
    add_boundary_outflow(lamella.domain, suction.outflow, lamella.balance);
    for (int i = 0; i < lamella.domain.size(); ++i)
      rate.film[lamella.domain.film_dof[i]] = lamella.balance[i];
  }
}

void DrainageEquations::rates(const Unknowns& y, Unknowns& rate) {
  evaluate_suction(sites_, y.film, y.border, materials_, suction_);
  evaluate_film_rates(y, suction_, rate);
  rate.border.assign(y.border.size(), 0.0);
  evaluate_border_roots(y.border, border_root_);
  add_border_flow(borders_, border_root_, materials_, rate.border);
  add_border_source(sites_, suction_.outflow, rate.border);
}

void DrainageEquations::linearise(const Unknowns& y, Unknowns& rate) {
  evaluate_suction(sites_, y.film, y.border, materials_, linearised_suction_);
  evaluate_film_rates(y, linearised_suction_, rate);
  for (LamellaSystem& lamella : lamellae_)
    lamella.jacobian.evaluate(lamella.domain, lamella.eta, lamella.potential, materials_,
                              linearised_suction_.slope);
  rate.border.assign(y.border.size(), 0.0);
  evaluate_border_roots(y.border, border_root_);
  linearise_border_flow(borders_, border_root_, materials_, rate.border, border_slope_);
  add_border_source(sites_, linearised_suction_.outflow, rate.border);
}

bool DrainageEquations::factorise_lamella(LamellaSystem& lamella) {
  const auto jacobian = lamella.jacobian.value();
  matrix_.resize(jacobian.size());
  std::transform(jacobian.begin(), jacobian.end(), matrix_.begin(), [s = s_](double j) { return -s * j; });
  for (int i = 0; i < lamella.domain.size(); ++i)
    matrix_[lamella.jacobian.diagonal()[i]] += lamella.domain.surface.mass[i];
  return lamella.lu.assign(matrix_);
}

bool DrainageEquations::factorise(double s) {
  s_ = s;
  bool failed = false;
  shares_.communicator().together([&] {
    for (LamellaSystem& lamella : lamellae_) failed = failed || !factorise_lamella(lamella);
    failed = failed || !factorise_borders(s);
  });
  return !shares_.communicator().any(failed);
}

/// Solves for one lamella. What the iteration leaves and round-off in the factors, which can be felt where
/// tiny triangles make J huge, add to or take from its liquid is given back in proportion to η: Σ m k + (s/2)
/// Σ slope k = Σ b holds as exactly as it can be summed.
void DrainageEquations::solve_lamella(LamellaSystem& lamella, Unknowns& b) const {
  const auto& domain = lamella.domain;
  const auto& mass = domain.surface.mass;
  std::vector<double>& k = lamella.balance;
  double missing = 0, capacity = 0;
  for (int i = 0; i < domain.size(); ++i) missing += k[i] = b.film[domain.film_dof[i]];
  lamella.lu.solve(k, lamella.eta, lamella.weight);
  for (int i = 0; i < domain.size(); ++i) {
    missing -= mass[i] * k[i];
    capacity += mass[i] * lamella.eta[i];
  }
  for (const RimNode& node : domain.rim) {
    const double loss = 0.5 * s_ * linearised_suction_.slope[node.site];
    missing -= loss * k[node.unknown];
    capacity += loss * lamella.eta[node.unknown];
  }
  for (int i = 0; i < domain.size(); ++i)
    b.film[domain.film_dof[i]] = k[i] + missing / capacity * lamella.eta[i];
}

void DrainageEquations::solve(Unknowns& b) {
  shares_.communicator().together([&] {
    for (LamellaSystem& lamella : lamellae_) solve_lamella(lamella, b);
  });
  shares_.exchange(b.film);
  if (border_lu_) solve_borders(b);
}

void DrainageEquations::solve_borders(Unknowns& b) {
  for (std::size_t n = 0; n < sites_.size(); ++n)
    b.border[sites_[n].border_unknown] += s_ * linearised_suction_.slope[n] * b.film[sites_[n].film_dof];
  const double gained = std::accumulate(b.border.begin(), b.border.end(), 0.0);
  border_lu_->solve(b.border);
  const double found = std::inner_product(b.border.begin(), b.border.end(), borders_.length.begin(), 0.0);
  const double missing = (gained - found) / total_border_length_;
  for (double& k : b.border) k += missing;
}

void DrainageEquations::build_border_system() {
  if (borders_.size() == 0) return;
  std::vector<std::array<int, 2>> coupled;
  for (const BorderLink& link : borders_.link) coupled.push_back(link.unknown);
  border_slope_.resize(coupled.size());
  border_coupling_.resize(coupled.size());
  border_diagonal_.resize(borders_.size());
  border_lu_.emplace(borders_.size(), coupled);
  total_border_length_ = std::accumulate(borders_.length.begin(), borders_.length.end(), 0.0);
}

/// What flows along an edge is taken from its first unknown and given to its second.
bool DrainageEquations::factorise_borders(double s) {
  if (!border_lu_) return true;
  std::copy(borders_.length.begin(), borders_.length.end(), border_diagonal_.begin());
  for (std::size_t n = 0; n < borders_.link.size(); ++n) {
    const auto [from, to] = borders_.link[n].unknown;
    const double by_from = s * border_slope_[n][0], by_to = s * border_slope_[n][1];
    border_diagonal_[from] += by_from;
    border_diagonal_[to] -= by_to;
    border_coupling_[n] = {by_to, -by_from};
  }
  return border_lu_->factorise(border_diagonal_, border_coupling_);
}

}  // namespace spume::drainage
