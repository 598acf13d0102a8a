#pragma once

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
/// A step calls predict_normals(), makes face_velocity() free of divergence, and calls advect().
class Godunov {
 public:
  Godunov(const grid::Grid& grid, bool limit_slopes);

  /// Predicts the velocities normal to faces at tⁿ + ½Δt into face_velocity(); zero at walls.
  /// `acceleration` [m/s²]: of the owned cells and one layer around them. `speed`: max |u| [m/s] over all
  /// ranks, against which a wind is called zero. Keeps slopes and transverse terms for advect().
  void predict_normals(const GhostedVector& u, const BlockVector& acceleration, double speed, double dt);

  /// u_MAC [m/s] of the faces of the owned cells.
  BlockVector& face_velocity() { return face_velocity_; }

  /// (u·∇u)^{n+½} of all components in conservative form,
  ///   advection = Σ_d ((u_MAC,d u)_{d+½} − (u_MAC,d u)_{d−½}) / h [m/s²].
  /// Takes the velocity, acceleration and step of the last predict_normals().
  void advect(const GhostedVector& u, const BlockVector& acceleration, double dt,
              grid::VectorField& advection);

 private:
  struct NormalTrace;
  struct FaceStates;
  NormalTrace normal_trace(const GhostedVector& u, int component, int axis, double dt) const;
  FaceStates face_states(const GhostedVector& u, const BlockVector& acceleration, int component, int axis,
                         double dt) const;
  void trace_normals(const GhostedVector& u, double dt);
  void transverse_terms(const GhostedVector& u, double dt);
  void close_walls();

  const grid::Grid& grid_;
  BlockLayout layout_;
  bool limit_;
  double calm_ = 0;                        ///< a wind below this has no direction [m/s]
  std::array<BlockVector, 3> slope_;       ///< [component][axis]: h ∂u_c/∂x_axis [m/s]
  std::array<BlockVector, 3> transverse_;  ///< [component][axis]: u_axis ∂u_c/∂x_axis [m/s²]
  BlockVector face_velocity_;
  BlockArray face_;  ///< one value or flux a face
};

}  // namespace spume::flow
