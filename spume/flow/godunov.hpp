#pragma once

#include <memory>

#include "spume/flow/block.hpp"

namespace spume::flow {

/// Unsplit second-order Godunov advection of the velocity, (u·∇u)^{n+½}, paper Sec. 3.2.1, after Almgren,
/// Bell, Colella, Howell and Welcome, J. Comput. Phys. 142 (1998) 1. Time-centred face values are Taylor
/// expansions from both sides of a face across `axis`,
///   u^{n+½} = u ± ½ (1 ∓ u_axis Δt/h) h ∂u/∂x_axis + ½Δt (a − Σ_{e≠axis} u_e ∂u/∂x_e),
/// a the acceleration by pressure gradient, viscosity and body force, of which the wind chooses one. The
/// transverse derivatives use face values traced along e alone, without the corner coupling of a fully
/// upwinded scheme: stable for CFL numbers up to ½.
///
/// A step calls predict_normals(), makes face_velocity() free of divergence, and calls advect() or
/// accelerate().
///
/// Both halves of the work go through the cells tile by tile, the work values of a tile staying in cache;
/// slopes and transverse terms are computed in either, which costs less than to keep them for all cells.
class Godunov {
 public:
  Godunov(const grid::Grid& grid, bool limit_slopes);
  ~Godunov();

  /// Predicts the velocities normal to faces at tⁿ + ½Δt into face_velocity(); zero at walls.
  /// `acceleration` [m/s²]: of the owned cells and one layer around them. `speed`: max |u| [m/s] over all
  /// ranks, against which a wind is called zero.
  void predict_normals(const GhostedVector& u, const BlockVector& acceleration, double speed, double dt);

  /// u_MAC [m/s] of the faces of the owned cells.
  BlockVector& face_velocity() { return face_velocity_; }

  /// (u·∇u)^{n+½} of all components in conservative form,
  ///   advection = Σ_d ((u_MAC,d u)_{d+½} − (u_MAC,d u)_{d−½}) / h [m/s²].
  /// Takes the velocity, acceleration and step of the last predict_normals().
  void advect(const GhostedVector& u, const BlockVector& acceleration, double dt,
              grid::VectorField& advection);

  /// The rate of change by acceleration and advection, a − (u·∇u)^{n+½} [m/s²], otherwise as advect().
  void accelerate(const GhostedVector& u, const BlockVector& acceleration, double dt,
                  grid::VectorField& rate);

 private:
  struct Tile;
  struct Known;
  Known known(const GhostedVector& u, const BlockVector& acceleration, double dt) const;
  template <class Body>
  void for_each_tile(Body&& body);
  template <class Store>
  void advect_each_row(const GhostedVector& u, const BlockVector& acceleration, double dt, Store&& store);
  void close_walls();

  const grid::Grid& grid_;
  BlockLayout layout_;
  bool limit_;
  double calm_ = 0;  ///< a wind below this has no direction [m/s]
  BlockVector face_velocity_;
  std::unique_ptr<Tile> tile_;
};

}  // namespace spume::flow
