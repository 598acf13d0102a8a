#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "spume/drainage/paper_lamella.hpp"
#include "spume/state/film_network.hpp"
#include "spume/state/materials.hpp"

/// The test surface of the paper's Sec. 4.3.1: (cosh v cos u, cosh v sin u, v), |v| ≤ 5/4, a minimal surface
/// of principal curvatures ± sech² v. μ = 1, σ = 0.2, ρg = 0.5.
namespace spume::verification {

/// Gravity along the given unit vector.
state::Materials catenoid_materials(const Vec3& direction);

/// How the quadrilaterals of the mesh are cut and where its vertices are.
enum class CatenoidMesh {
  Regular,  ///< equal sections of u and v, one way of cutting
  Uneven,   ///< vertices off by up to a fifth of a section, quadrilaterals cut either way, at random
};

/// n sections of v, 2n of u, as a film with exact k = 2 sech⁴ v; `parameter` are u, v of its film dofs.
struct Catenoid {
  state::FilmNetwork network;
  std::vector<std::array<double, 2>> parameter;
  /// The boundary edges, by film dofs.
  std::vector<std::array<int, 2>> boundary_edge;
};
Catenoid catenoid(int n, CatenoidMesh kind = CatenoidMesh::Regular);

/// Unit normal at u, v.
Vec3 catenoid_normal(double u, double v);
/// Distance to the catenoid that goes on for ever, positive outside.
double catenoid_distance(const Vec3& x);

/// The surface as the published scheme takes it, with exact k and g_s.
drainage::LamellaSurface catenoid_surface(const Catenoid& mesh, const Vec3& gravity);

/// Largest circumscribed diameter of its triangles, the paper's h.
double largest_diameter(const state::FilmNetwork& network);

/// The solution of Table 1, η = 1 + ¼ sin(u + t) cos(4πv/5), gravity along z, with what drives it.
struct CatenoidSolution {
  double eta;     ///< η
  double source;  ///< f = η_t + ∇_s·Q
  double flux;    ///< Q·ν outward at the boundary v > 0; at v < 0 outward as well
};
CatenoidSolution catenoid_solution(double u, double v, double t);

/// Largest nodal error and largest norm ‖·‖₂ of the piecewise linear error over all times.
struct LamellaError {
  double largest = 0, norm = 0;
  double seconds = 0;  ///< processor time of the steps, without their source [s]
};

/// A way to advance η on a catenoid from t by dt; tells the processor time that took, without that of the
/// source, which is the problem's and not the scheme's [s].
using LamellaRun = std::function<double(double t, double dt, std::vector<double>& eta)>;
/// How a source enters the equations: as the paper has it, piecewise linear between its nodal values, or
/// integrated to fifth order, which leaves the error of the scheme alone.
enum class SourceRule { Interpolated, Integrated };
/// Those of the published scheme and of the positive one, with the source and flux of Table 1 or without any.
LamellaRun published_lamella_run(const Catenoid& mesh, drainage::LamellaSurface surface,
                                 const state::Materials& materials, bool driven);
LamellaRun positive_lamella_run(const Catenoid& mesh, const state::Materials& materials,
                                std::optional<SourceRule> driven);

/// Table 1: error over 0 ≤ t ≤ end.
LamellaError lamella_error(const Catenoid& mesh, const LamellaRun& run, double end, int steps);

/// η at t = end of a run that starts on the solution of Table 1.
std::vector<double> lamella_end(const Catenoid& mesh, const LamellaRun& run, double end, int steps);

/// Table 2: η = 1 drains for 0 ≤ t ≤ 2; η at t = 1/4, 1/2, …, 2. Takes a multiple of 8 steps.
using LamellaHistory = std::vector<std::vector<double>>;
LamellaHistory lamella_history(const Catenoid& mesh, const LamellaRun& run, int steps);
/// ∫ η dA at each of those times.
std::vector<double> lamella_liquid(const Catenoid& mesh, const LamellaHistory& history);
/// How far the run on a regular mesh of n sections is from that of 2n, on the vertices of the coarser.
LamellaError lamella_difference(const Catenoid& coarse, const LamellaHistory& eta_coarse, int n,
                                const LamellaHistory& eta_fine);

}  // namespace spume::verification
