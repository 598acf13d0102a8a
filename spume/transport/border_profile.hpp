#pragma once

#include <span>
#include <vector>

#include "spume/transport/liquid_mesh.hpp"

namespace spume::transport {

/// The cross-section λ along every border as a function of arc length: a cubic spline, kept within the
/// extrema of the four vertices around each edge, plus the height of a smooth crest (no overshoot at steps
/// and spikes, never negative); linear on borders of fewer than four vertices.
class BorderProfile {
 public:
  /// From the liquid at the border dofs [m³]. `h` [m] sets what length counts as none.
  BorderProfile(const LiquidMesh& mesh, std::span<const double> volume, double h);

  /// λ [m²] on a border edge, at the fraction `t` of the way from its first vertex to its second.
  double at(int edge, double t) const;

 private:
  /// A piece of spline in the direction of its edge.
  struct Piece {
    double length = 0, value0 = 0, value1 = 0, slope0 = 0, slope1 = 0;
    double least = 0, most = 0;
  };
  void fit_border(const LiquidMesh& mesh, int border, std::span<const int> edges,
                  std::span<const double> value);

  std::vector<Piece> piece_;  ///< per border edge
};

}  // namespace spume::transport
