#include "spume/drainage/paper_drain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

#include "spume/base/error.hpp"
#include "spume/drainage/constants.hpp"
#include "spume/drainage/lamella_shares.hpp"
#include "spume/drainage/paper_border.hpp"
#include "spume/drainage/paper_lamella.hpp"
#include "spume/drainage/place.hpp"
#include "spume/drainage/suction.hpp"
#include "spume/fem/triangle_matrices.hpp"
#include "spume/mesh/measure.hpp"

namespace spume::drainage {
namespace {

/// A lamella and the film dof of each of its nodes.
struct NumberedLamella {
  std::vector<int> film_dof;
  LamellaSurface surface;
};

/// The lamellae of the given numbers.
std::vector<NumberedLamella> cut_into_lamellae(const state::FilmNetwork& network, const Vec3& gravity,
                                               const std::vector<int>& wanted) {
  const auto& topology = network.topology;
  std::vector<NumberedLamella> lamellae(topology.n_lamellae());
  std::vector<int> node;
  const std::vector<Vec3> normal = mesh::film_dof_normals(network.mesh, topology);
  for (std::size_t d = 0; d < topology.film_dof.size(); ++d) {
    NumberedLamella& lamella = lamellae[topology.film_dof[d].lamella];
    node.push_back(static_cast<int>(lamella.film_dof.size()));
    lamella.film_dof.push_back(static_cast<int>(d));
    lamella.surface.position.push_back(network.mesh.position[topology.film_dof[d].vertex]);
    lamella.surface.curvature_squared.push_back(network.curvature_squared[d]);
    lamella.surface.tangential_gravity.push_back(gravity - dot(gravity, normal[d]) * normal[d]);
    lamella.surface.domain = network.mesh.domain;
  }
  for (int t = 0; t < network.mesh.n_triangles(); ++t) {
    const auto& dof = topology.corner_dof[t];
    lamellae[topology.triangle_lamella[t]].surface.triangle.push_back(
        {node[dof[0]], node[dof[1]], node[dof[2]]});
  }
  std::vector<NumberedLamella> cut;
  for (int l : wanted) cut.push_back(std::move(lamellae[l]));
  return cut;
}

/// At a junction the scheme knows ends of borders alone, each with two edges to take differences along.
/// Elsewhere a border that touches itself would be two.
void check_borders(const state::FilmNetwork& network) {
  const auto& topology = network.topology;
  const auto refuse = [&](int vertex, const std::string& what) {
    throw InputError("the published drainage scheme cannot treat " + what + " at " +
                     place_text(network.mesh.position[vertex]) +
                     "; use a finer mesh or drainage.scheme = \"positive\"");
  };
  std::vector<int> n_edges(topology.border_dof.size(), 0);
  for (const auto& edge : topology.border_edge)
    for (int dof : edge.border_dof) ++n_edges[dof];
  for (std::size_t d = 0; d < n_edges.size(); ++d) {
    const int v = topology.border_dof[d].vertex;
    if (n_edges[d] > 2) refuse(v, "a Plateau border that touches itself");
    if (n_edges[d] == 2 && topology.vertex_kind[v] == mesh::VertexKind::Junction)
      refuse(v, "a Plateau border that goes on through the junction");
  }
  for (const auto& border : topology.border)
    if (!border.closed && border.vertices.size() < 3)
      for (int v : {border.vertices.front(), border.vertices.back()})
        if (topology.vertex_kind[v] == mesh::VertexKind::Junction)
          refuse(v, "a Plateau border of a single edge that ends in the junction");
}

/// The borders of the network, one curve each, in their order.
BorderCurves follow_borders(const state::FilmNetwork& network, const Vec3& gravity) {
  check_borders(network);
  const auto& topology = network.topology;
  BorderCurves borders;
  std::map<int, std::vector<BorderTip>> tips;  // of each junction
  for (int v : topology.junction) tips[v];
  for (int b = 0; b < topology.n_borders(); ++b) {
    const auto& chain = topology.border[b].vertices;
    BorderCurve curve;
    curve.closed = topology.border[b].closed;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const Vec3 edge = network.mesh.edge(chain[i], chain[i + 1]);
      curve.length.push_back(norm(edge));
      curve.descent.push_back(dot(gravity, edge));
      if (!(curve.length.back() > 0))
        throw_at("an edge of a Plateau border has no length", network.mesh.position[chain[i]]);
    }
    borders.curve.push_back(std::move(curve));
    if (topology.border[b].closed) continue;
    for (const bool at_end : {false, true})
      if (const auto at = tips.find(at_end ? chain.back() : chain.front()); at != tips.end())
        at->second.push_back({b, at_end});
  }
  for (int v : topology.junction) borders.junction.push_back(tips[v]);
  return borders;
}

/// One film along one border edge: its dofs and the nodes of the border at the two ends.
struct Contact {
  std::array<int, 2> film_dof, border_node;
  double length;  ///< [m]
};

/// The paper's iteration (Sec. 3.3) on a network.
class PaperStage {
 public:
  PaperStage(state::FilmNetwork& network, const state::Materials& materials,
             const parallel::Communicator& communicator)
      : network_(network),
        materials_(materials),
        shares_(network.topology, communicator),
        borders_(follow_borders(network, materials.gravity), materials),
        lambda_(borders_.n_nodes()),
        border_load_(borders_.n_nodes()),
        film_load_(network.half_thickness.size()) {
    communicator.together([&] {
      for (NumberedLamella& lamella : cut_into_lamellae(network, materials.gravity, shares_.own())) {
        film_dof_.push_back(std::move(lamella.film_dof));
        lamella_.emplace_back(std::move(lamella.surface), materials);
      }
    });
    for (int b = 0; b < network.topology.n_borders(); ++b) {
      const auto& chain = network.topology.border[b].vertices;
      for (int i = 0; i < borders_.curves().curve[b].n_nodes(); ++i) vertex_.push_back(chain[i]);
    }
    find_contacts();
    check_start();
    for (std::size_t n = 0; n < vertex_.size(); ++n) lambda_[n] = network_.border_area[vertex_[n]];
  }

  /// Of the network [m³]: what is handed back, not what the stage took apart. Collective.
  double liquid() const {
    std::vector<double> lambda;
    for (int v : vertex_) lambda.push_back(network_.border_area[v]);
    std::vector<double> of_lamella(network_.topology.n_lamellae(), 0.0);
    std::vector<double> eta;
    for (std::size_t l = 0; l < lamella_.size(); ++l) {
      gather(network_.half_thickness, l, eta);
      of_lamella[shares_.own()[l]] = 2 * lamella_[l].liquid(eta);
    }
    shares_.communicator().sum(of_lamella);  // exact: one rank has each
    return std::accumulate(of_lamella.begin(), of_lamella.end(), borders_.liquid(lambda));
  }

  /// What drain_as_published() says, without max_step; infinite if nothing limits the step.
  double step_limit();

  /// One step from `elapsed` [s]; changes the network. Collective.
  void advance(double elapsed, double dt) {
    integrate_suction();
    shares_.communicator().together([&] {
      for (std::size_t l = 0; l < lamella_.size(); ++l) advance_lamella(l, elapsed, dt);
    });
    shares_.exchange(network_.half_thickness);
    if (const auto fault = borders_.advance(dt, border_load_, lambda_)) fail(elapsed, dt, describe(*fault));
    borders_.project(lambda_);
    for (std::size_t n = 0; n < vertex_.size(); ++n) network_.border_area[vertex_[n]] = lambda_[n];
  }

 private:
  void advance_lamella(std::size_t l, double elapsed, double dt) {
    gather(network_.half_thickness, l, eta_);
    gather(film_load_, l, load_);
    if (!lamella_[l].advance(dt, load_, eta_))
      fail(elapsed, dt,
           "the equations of a film could not be solved, or η grows without bound: " + describe_thickest(l));
    for (std::size_t i = 0; i < eta_.size(); ++i) {
      if (!(eta_[i] > 0)) fail(elapsed, dt, describe_film_dof(network_, film_dof_[l][i], eta_[i]));
      network_.half_thickness[film_dof_[l][i]] = eta_[i];
    }
  }

  void find_contacts();
  void check_start() const;
  void integrate_suction();

  void gather(const std::vector<double>& of_dofs, std::size_t lamella, std::vector<double>& own) const {
    own.clear();
    for (int d : film_dof_[lamella]) own.push_back(of_dofs[d]);
  }

  std::string describe_thickest(std::size_t lamella) const {
    const auto thickest = std::max_element(
        film_dof_[lamella].begin(), film_dof_[lamella].end(),
        [&](int a, int b) { return network_.half_thickness[a] < network_.half_thickness[b]; });
    return describe_film_dof(network_, *thickest, network_.half_thickness[*thickest]);
  }

  std::string describe(const BorderFault& fault) const {
    if (fault.junction >= 0)
      return "no cross-section that balances the fluxes of a junction, " +
             place_text(network_.mesh.position[network_.topology.junction[fault.junction]]);
    return describe_border_vertex(network_, vertex_[borders_.offset()[fault.curve] + fault.node],
                                  fault.value);
  }

  [[noreturn]] void fail(double elapsed, double dt, const std::string& what) const {
    std::ostringstream message;
    message << "the published drainage scheme failed " << elapsed + dt << " s after its start, with steps of "
            << dt << " s: " << what << ". It keeps the liquid, but not η and λ positive, whatever the step; "
            << "drainage.scheme = \"positive\" does";
    throw NumericalError(message.str());
  }

  state::FilmNetwork& network_;
  const state::Materials materials_;
  LamellaShares shares_;
  std::vector<PaperLamella> lamella_;       ///< of this rank
  std::vector<std::vector<int>> film_dof_;  ///< of the nodes of each of them
  PaperBorders borders_;
  std::vector<int> vertex_;  ///< of each node of the borders
  std::vector<Contact> contact_;
  std::vector<double> lambda_, border_load_, film_load_;
  std::vector<double> eta_, load_;  ///< of one lamella
};

void PaperStage::find_contacts() {
  const auto& topology = network_.topology;
  std::map<std::pair<int, int>, int> node;  // of border and vertex
  for (int b = 0; b < topology.n_borders(); ++b)
    for (int n = borders_.offset()[b]; n < borders_.offset()[b + 1]; ++n) node[{b, vertex_[n]}] = n;
  for (const auto& edge : topology.border_edge)
    for (int t : edge.triangle) {
      Contact contact;
      contact.length = norm(network_.mesh.edge(edge.vertex[0], edge.vertex[1]));
      for (int end = 0; end < 2; ++end) {
        contact.border_node[end] = node.at({edge.border, edge.vertex[end]});
        for (int corner = 0; corner < 3; ++corner)
          if (network_.mesh.triangle[t].vertex[corner] == edge.vertex[end])
            contact.film_dof[end] = topology.corner_dof[t][corner];
      }
      contact_.push_back(contact);
    }
}

void PaperStage::check_start() const {
  for (std::size_t d = 0; d < network_.half_thickness.size(); ++d)
    if (!(network_.half_thickness[d] > 0) || !std::isfinite(network_.half_thickness[d]) ||
        !std::isfinite(network_.curvature_squared[d]))
      throw NumericalError("drainage cannot start: " +
                           describe_film_dof(network_, static_cast<int>(d), network_.half_thickness[d]));
  for (int v : vertex_)
    if (!(network_.border_area[v] > 0) || !std::isfinite(network_.border_area[v]))
      throw NumericalError("drainage cannot start: " +
                           describe_border_vertex(network_, v, network_.border_area[v]));
}

/// Q is piecewise linear along the border and weighted with the basis functions, in films and borders alike.
void PaperStage::integrate_suction() {
  std::fill(film_load_.begin(), film_load_.end(), 0.0);
  std::fill(border_load_.begin(), border_load_.end(), 0.0);
  for (const Contact& contact : contact_) {
    const auto mass = fem::segment_mass(contact.length);
    for (int j = 0; j < 2; ++j) {
      const double q =
          suction(network_.half_thickness[contact.film_dof[j]], lambda_[contact.border_node[j]], materials_);
      for (int i = 0; i < 2; ++i) {
        film_load_[contact.film_dof[i]] -= 0.5 * mass[i][j] * q;
        border_load_[contact.border_node[i]] += mass[i][j] * q;
      }
    }
  }
}

double PaperStage::step_limit() {
  double limit = std::numeric_limits<double>::infinity();
  const double mobility = border_flow / materials_.liquid.viscosity;
  const double c1 = border_tension(materials_.film.surface_tension);
  const double weight = materials_.liquid.density * norm(materials_.gravity);
  for (const auto& tips : borders_.curves().junction)
    for (const BorderTip& tip : tips) {
      const auto& curve = borders_.curves().curve[tip.curve];
      const double h = tip.at_end ? curve.length.back() : curve.length.front();
      const double lambda =
          lambda_[tip.at_end ? borders_.offset()[tip.curve + 1] - 1 : borders_.offset()[tip.curve]];
      limit = std::min(
          {limit, 2 * h * h / (mobility * c1 * std::sqrt(lambda)), h / (4 * mobility * lambda * weight)});
    }
  integrate_suction();
  const auto area = mesh::film_dof_areas(network_.mesh, network_.topology);
  for (std::size_t d = 0; d < area.size(); ++d)
    if (film_load_[d] < 0)
      limit = std::min(limit, 0.2 * area[d] * network_.half_thickness[d] / -film_load_[d]);
  return limit;
}

}  // namespace

DrainageOutcome drain_as_published(state::FilmNetwork& network, const state::Materials& materials,
                                   const DrainageParameters& parameters, double threshold,
                                   const ThinnestPoint& thinnest, const OnStep& on_step,
                                   const parallel::Communicator& communicator) {
  PaperStage stage(network, materials, communicator);
  const double step = std::min(stage.step_limit(), parameters.max_step);
  const double initial_liquid = stage.liquid();
  DrainageOutcome outcome{Ending::Drained, 0, thinnest(network), 0, 0, 0};
  const auto ruptured = [&] {
    return outcome.thinnest.film_dof >= 0 && outcome.thinnest.half_thickness < threshold;
  };
  bool go_on = true;
  while (go_on && !ruptured() && outcome.elapsed < parameters.max_time) {
    const double remaining = parameters.max_time - outcome.elapsed;
    const bool last = step >= remaining * (1 - 1e-9);
    stage.advance(outcome.elapsed, last ? remaining : step);
    outcome.elapsed = last ? parameters.max_time : outcome.elapsed + step;
    outcome.thinnest = thinnest(network);
    ++outcome.n_steps;
    const std::string limited_by = ruptured() ? "rupture" : last ? "end of stage" : "fixed step";
    go_on = !on_step || on_step({outcome.elapsed, last ? remaining : step, outcome.n_steps, 0,
                                 outcome.thinnest, limited_by},
                                network);
  }
  if (ruptured())
    outcome.ending = Ending::Ruptured;
  else if (!go_on)
    outcome.ending = Ending::Stopped;
  outcome.ledger_error = (stage.liquid() - initial_liquid) / initial_liquid;
  return outcome;
}

}  // namespace spume::drainage
