#pragma once

#include <vector>

#include "spume/grid/box.hpp"
#include "spume/io/labelled_image.hpp"
#include "spume/simulation/case.hpp"

namespace spume::config {

/// Sizes of a foam, estimated from the bubbles before any film mesh exists.
struct FoamEstimate {
  double film_area = 0;      ///< every film once [m²]; true to about 5 %
  double border_length = 0;  ///< of Plateau borders [m]; true to about 20 %
  double gas_volume = 0;     ///< in the bubbles [m³]

  /// A part of the outside that bubbles enclose.
  struct Pocket {
    Vec3 position;  ///< of its centroid [m]
    double volume;  ///< [m³]
  };
  std::vector<Pocket> pockets;
};

/// Marks cells by the bubble whose power potential is largest and counts: a surface of any shape crosses on
/// average (3/2) A/h² faces between cells and a line (3/2) L/h edges, since the mean of |n_x| + |n_y| + |n_z|
/// over all directions is 3/2. Grids of more than four million cells are coarsened to that.
FoamEstimate estimate_foam(const std::vector<simulation::BubbleShape>& bubbles, const grid::Box& box);

/// The same from a labelled image that has its place in the box. Pockets are not looked for.
FoamEstimate estimate_labels(const io::LabelledImage& image, const grid::Box& box);

/// Of a foam that fills a periodic box: film area 2.65 V^(2/3) and border length 5.35 V^(1/3) a bubble of
/// volume V, those of Kelvin's foam, from which other dry foams of like bubbles differ by a few per cent.
FoamEstimate estimate_full_box(int n_bubbles, const grid::Box& box);

}  // namespace spume::config
