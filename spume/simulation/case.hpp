#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "spume/base/vec3.hpp"
#include "spume/drainage/drain.hpp"
#include "spume/flow/navier_stokes.hpp"
#include "spume/grid/box.hpp"
#include "spume/interface/reconstruct.hpp"
#include "spume/meshing/mesh_films.hpp"
#include "spume/rupture/criterion.hpp"
#include "spume/simulation/lattice.hpp"
#include "spume/state/materials.hpp"
#include "spume/transport/transfer.hpp"

namespace spume::simulation {

/// A bubble of the initial foam. Overlaps are shared along the power plane.
struct BubbleShape {
  Vec3 center;     ///< [m]
  Vec3 semi_axes;  ///< [m]; all equal for a sphere
};

/// A seeded cluster of bubbles that touch, without enclosed pockets of the outside.
struct ClusterShape {
  int count = 8;
  double mean_diameter = 3e-3;  ///< [m]
  double spread = 0.2;          ///< relative standard deviation of the diameters
  std::uint64_t seed = 1;
  std::optional<Vec3> center;  ///< [m]; the middle of the box when not given
};

/// A foam from a labelled voxel image. Key section [foam.labels].
struct LabelsSource {
  std::string file;
  enum class Placement {
    Box,   ///< the image is stretched over the box, whose proportions it must have; its file's place and
           ///< unit of length are not used
    File,  ///< origin and spacing of the file are metres
  } placement = Placement::Box;
};

/// Films from a file of the series films.pvd, or of that form, to drain as they are. Key section
/// [foam.films].
struct FilmsSource {
  std::string file;
  enum class Liquid {
    File,    ///< η and λ are those of the file
    Uniform  ///< those of [foam] everywhere
  } liquid = Liquid::File;
};

/// A flat film across the box, which splits the outside: below it is phase 0, above it, where the normal
/// points, the last phase, N + 1. Bubbles may sit on it. Its edges close on themselves through periodic
/// faces.
struct MembraneShape {
  Vec3 point;            ///< on the film [m]
  Vec3 normal{0, 0, 1};  ///< along an axis; of any length
};

/// Key section [foam].
struct InitialFoam {
  double lamella_half_thickness = 5e-6;            ///< η everywhere at the start [m]
  double border_area = 1e-9;                       ///< λ everywhere at the start [m²]
  bool equilibrate = false;                        ///< relax to equilibrium before time 0
  std::vector<std::array<int, 2>> remove_lamella;  ///< pairs of phases whose films are torn at time 0
  std::vector<BubbleShape> bubble;
  std::optional<ClusterShape> cluster;
  std::optional<LatticeShape> lattice;
  std::optional<LabelsSource> labels;
  std::optional<FilmsSource> films;
  std::optional<MembraneShape> membrane;
};

/// Key section [rearrangement].
struct RearrangementParameters {
  double max_time = 0.1;                ///< of one rearrangement stage [s]
  double equilibrium_tolerance = 1e-3;  ///< see simulation/equilibrium.hpp
  double cfl = 0.4;
  int reconstruction_interval = 50;        ///< steps, while the films move
  double reconstruction_displacement = 1;  ///< of a vertex since the last reconstruction [h]
  bool conserve_volumes = true;
  enum class Interface { Mesh, Viim } interface = Interface::Mesh;
  double epsilon = 1.5;  ///< of the Voronoi implicit interface method [h]
  enum class Dynamics { Gas, Quasistatic } dynamics = Dynamics::Gas;
  double capillary_factor = 0.8;  ///< C in Δt ≤ C sqrt(ρ h³/2σ)
};

enum class Stage { Rearrange, Drain, Rupture };
/// "rearrange", "drain" or "rupture".
const char* name(Stage stage);

/// Key section [cycle].
struct CycleParameters {
  double end_time = 1e9;  ///< [s]
  int max_ruptures = 1000000;
  std::vector<Stage> stages{Stage::Rearrange, Stage::Drain, Stage::Rupture};
};

/// Key section [output].
struct OutputParameters {
  double rearrangement_interval = 1e-3;                                          ///< between frames [s]
  double drainage_interval = 1;                                                  ///< between frames [s]
  bool gas = false;                                                              ///< write gas.pvd too
  std::vector<std::string> fields{"velocity", "pressure", "phase", "distance"};  ///< of gas.pvd
};

/// All that a run is asked to do. Constant after reading.
struct Case {
  std::string title;
  grid::Box box;
  state::Materials materials;
  InitialFoam foam;
  RearrangementParameters rearrangement;
  drainage::DrainageParameters drainage;
  rupture::RuptureParameters rupture;
  CycleParameters cycle;
  OutputParameters output;

  flow::FlowParameters flow;
  interface::ReconstructParameters reconstruct;
  transport::TransportParameters transport;
  meshing::MeshingParameters meshing;
};

}  // namespace spume::simulation
