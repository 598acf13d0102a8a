#include "spume/config/keys.hpp"

#include <algorithm>

namespace spume::config {

namespace {

using simulation::Case;

/// A choice bound to an enumeration whose values stand in the order of `names`.
template <class Record, class Enum>
Choice<Record> choice(std::vector<std::string> names, Member<Record, Enum> member) {
  return {.names = std::move(names),
          .get = [member](Record& record) { return std::vector<int>{static_cast<int>(member(record))}; },
          .set = [member](
                     Record& record,
                     const std::vector<int>& chosen) { member(record) = static_cast<Enum>(chosen.front()); }};
}

Choice<Case> boundary_choice() {
  return {.names = {"periodic", "wall", "slip"},
          .get =
              [](Case& c) {
                const auto& boundary = c.box.boundary;
                return std::vector<int>{static_cast<int>(boundary[0]), static_cast<int>(boundary[1]),
                                        static_cast<int>(boundary[2])};
              },
          .set =
              [](Case& c, const std::vector<int>& chosen) {
                for (int axis = 0; axis < 3; ++axis)
                  c.box.boundary[axis] = static_cast<grid::Boundary>(chosen[axis]);
              },
          .count = 3};
}

Choice<Case> stages_choice() {
  return {.names = {"rearrange", "drain", "rupture"},
          .get =
              [](Case& c) {
                std::vector<int> chosen;
                for (const auto stage : c.cycle.stages) chosen.push_back(static_cast<int>(stage));
                return chosen;
              },
          .set =
              [](Case& c, const std::vector<int>& chosen) {
                c.cycle.stages.clear();
                for (const int place : chosen)
                  c.cycle.stages.push_back(static_cast<simulation::Stage>(place));
              },
          .count = Choice<Case>::any_count};
}

Choice<Case> fields_choice() {
  const std::vector<std::string> names{"velocity", "pressure", "phase", "distance"};
  return {.names = names,
          .get =
              [names](Case& c) {
                std::vector<int> chosen;
                for (const auto& field : c.output.fields)
                  chosen.push_back(static_cast<int>(std::ranges::find(names, field) - names.begin()));
                return chosen;
              },
          .set =
              [names](Case& c, const std::vector<int>& chosen) {
                c.output.fields.clear();
                for (const int place : chosen) c.output.fields.push_back(names[place]);
              },
          .count = Choice<Case>::any_count};
}

simulation::ClusterShape& cluster(Case& c) {
  return c.foam.cluster ? *c.foam.cluster : c.foam.cluster.emplace();
}

simulation::LatticeShape& lattice(Case& c) {
  return c.foam.lattice ? *c.foam.lattice : c.foam.lattice.emplace();
}

simulation::LabelsSource& labels(Case& c) {
  return c.foam.labels ? *c.foam.labels : c.foam.labels.emplace();
}
simulation::FilmsSource& films(Case& c) {
  return c.foam.films ? *c.foam.films : c.foam.films.emplace();
}
simulation::MembraneShape& membrane(Case& c) {
  return c.foam.membrane ? *c.foam.membrane : c.foam.membrane.emplace();
}

using Keys = std::vector<Key<Case>>;

Keys box_keys() {
  return {
      {"title", Text<Case>{[](Case& c) -> std::string& { return c.title; }}, "", "",
       "a line that names the case"},
      {"gravity", Vector<Case>{[](Case& c) -> Vec3& { return c.materials.gravity; }}, "m/s²", "g",
       "acceleration that acts on the liquid of the films"},
      {"domain.lower", Vector<Case>{[](Case& c) -> Vec3& { return c.box.lower; }}, "m", "",
       "corner of the box with the smallest coordinates", true},
      {"domain.upper", Vector<Case>{[](Case& c) -> Vec3& { return c.box.upper; }}, "m", "",
       "corner of the box with the largest coordinates", true},
      {"domain.cells", Counts<Case>{[](Case& c) -> Index3& { return c.box.cells; }, 16}, "", "",
       "cells along x, y, z; they must be cubes", true},
      {"domain.boundary", boundary_choice(), "", "", "what the gas meets at the faces across x, y, z"},
  };
}

Keys material_keys() {
  return {
      {"gas.density", Number<Case>{[](Case& c) -> double& { return c.materials.gas.density; }}, "kg/m³",
       "ρ_g", "density of the gas"},
      {"gas.viscosity", Number<Case>{[](Case& c) -> double& { return c.materials.gas.viscosity; }}, "Pa s",
       "μ_g", "viscosity of the gas"},
      {"liquid.density", Number<Case>{[](Case& c) -> double& { return c.materials.liquid.density; }}, "kg/m³",
       "ρ", "density of the liquid in the films"},
      {"liquid.viscosity", Number<Case>{[](Case& c) -> double& { return c.materials.liquid.viscosity; }},
       "Pa s", "μ", "viscosity of the liquid in the films"},
      {"film.surface_tension",
       Number<Case>{[](Case& c) -> double& { return c.materials.film.surface_tension; }}, "N/m", "σ",
       "tension of one liquid–gas face; a film has two"},
  };
}

Keys foam_keys() {
  return {
      {"foam.lamella_half_thickness",
       Number<Case>{[](Case& c) -> double& { return c.foam.lamella_half_thickness; }}, "m", "η",
       "half-thickness of all lamellae at the start"},
      {"foam.border_area", Number<Case>{[](Case& c) -> double& { return c.foam.border_area; }}, "m²", "λ",
       "cross-section of all Plateau borders at the start"},
      {"foam.equilibrate", Flag<Case>{[](Case& c) -> bool& { return c.foam.equilibrate; }}, "", "",
       "relax the films to equilibrium before time 0"},
      {"foam.remove_lamella",
       PhasePairs<Case>{[](Case& c) -> std::vector<std::array<int, 2>>& { return c.foam.remove_lamella; }},
       "", "", "pairs of phases whose films are torn at time 0"},
      {"foam.cluster.count", WholeNumber<Case>{[](Case& c) -> int& { return cluster(c).count; }, 1}, "", "",
       "number of bubbles"},
      {"foam.cluster.mean_diameter",
       Number<Case>{[](Case& c) -> double& { return cluster(c).mean_diameter; }}, "m", "",
       "mean diameter of the bubbles"},
      {"foam.cluster.spread",
       Number<Case>{[](Case& c) -> double& { return cluster(c).spread; }, Range{.lowest = 0, .highest = 0.6}},
       "", "", "standard deviation of the diameters over their mean"},
      {"foam.cluster.seed", Seed<Case>{[](Case& c) -> std::uint64_t& { return cluster(c).seed; }}, "", "",
       "the same seed gives the same bubbles"},
      {"foam.cluster.center",
       OptionalVector<Case>{[](Case& c) -> std::optional<Vec3>& { return cluster(c).center; }}, "m", "",
       "its centre; the middle of the box when not given"},
  };
}

Keys lattice_keys() {
  using simulation::LatticeShape;
  return {
      {"foam.lattice.structure",
       choice<Case, LatticeShape::Structure>(
           {"kelvin", "weaire-phelan", "random"},
           [](Case& c) -> LatticeShape::Structure& { return lattice(c).structure; }),
       "", "", "kelvin: 2 bubbles a cubic cell; weaire-phelan: 8; random: from seeded points"},
      {"foam.lattice.cells", WholeNumber<Case>{[](Case& c) -> int& { return lattice(c).cells; }, 1}, "", "",
       "of a crystal: cubic cells along the shortest side of the box"},
      {"foam.lattice.count", WholeNumber<Case>{[](Case& c) -> int& { return lattice(c).count; }, 8}, "", "",
       "of a random foam: number of bubbles"},
      {"foam.lattice.spread",
       Number<Case>{[](Case& c) -> double& { return lattice(c).spread; }, Range{.lowest = 0, .highest = 0.4}},
       "", "", "of a random foam: standard deviation of the diameters over their mean"},
      {"foam.lattice.seed", Seed<Case>{[](Case& c) -> std::uint64_t& { return lattice(c).seed; }}, "", "",
       "of a random foam: the same seed gives the same bubbles"},
  };
}

Keys labels_and_membrane_keys() {
  using simulation::LabelsSource;
  return {
      {"foam.labels.file", Text<Case>{[](Case& c) -> std::string& { return labels(c).file; }}, "", "",
       "vti, mha, mhd, nrrd or nhdr; a relative name starts at the folder of the case file"},
      {"foam.labels.placement",
       choice<Case, LabelsSource::Placement>(
           {"box", "file"}, [](Case& c) -> LabelsSource::Placement& { return labels(c).placement; }),
       "", "", "box: stretched over the box in proportion; file: origin and spacing of the file are metres"},
      {"foam.membrane.point", Vector<Case>{[](Case& c) -> Vec3& { return membrane(c).point; }}, "m", "",
       "a point of the film"},
      {"foam.membrane.normal", Vector<Case>{[](Case& c) -> Vec3& { return membrane(c).normal; }}, "", "",
       "direction across the film, along x, y or z; the phase above is the last one"},
  };
}

Keys films_keys() {
  using simulation::FilmsSource;
  return {
      {"foam.films.file", Text<Case>{[](Case& c) -> std::string& { return films(c).file; }}, "", "",
       "vtp of the form of films.pvd; a relative name starts at the folder of the case file"},
      {"foam.films.liquid",
       choice<Case, FilmsSource::Liquid>({"file", "uniform"},
                                         [](Case& c) -> FilmsSource::Liquid& { return films(c).liquid; }),
       "", "", "file: η and λ of the file; uniform: those of [foam] everywhere"},
  };
}

Keys rearrangement_keys() {
  using simulation::RearrangementParameters;
  return {
      {"rearrangement.max_time", Number<Case>{[](Case& c) -> double& { return c.rearrangement.max_time; }},
       "s", "", "longest duration of one stage"},
      {"rearrangement.equilibrium_tolerance",
       Number<Case>{[](Case& c) -> double& { return c.rearrangement.equilibrium_tolerance; }}, "", "",
       "distance from equilibrium at which a stage ends"},
      {"rearrangement.cfl",
       Number<Case>{[](Case& c) -> double& { return c.rearrangement.cfl; }, positive_up_to(0.5)}, "", "",
       "cells that the gas may cross in one step"},
      {"rearrangement.reconstruction_interval",
       WholeNumber<Case>{[](Case& c) -> int& { return c.rearrangement.reconstruction_interval; }, 1}, "steps",
       "", "steps between reconstructions of the moving films, at most"},
      {"rearrangement.reconstruction_displacement",
       Number<Case>{[](Case& c) -> double& { return c.rearrangement.reconstruction_displacement; },
                    positive_up_to(2)},
       "h", "", "displacement of a vertex after which the films are reconstructed"},
      {"rearrangement.conserve_volumes",
       Flag<Case>{[](Case& c) -> bool& { return c.rearrangement.conserve_volumes; }}, "", "",
       "give every bubble its volume back after each change of the films"},
      {"rearrangement.interface",
       choice<Case, RearrangementParameters::Interface>(
           {"mesh", "viim"},
           [](Case& c) -> RearrangementParameters::Interface& { return c.rearrangement.interface; }),
       "", "", "mesh: a mesh of the films moves; viim: distance and phase on the grid, as in the paper"},
      {"rearrangement.epsilon",
       Number<Case>{[](Case& c) -> double& { return c.rearrangement.epsilon; },
                    Range{.lowest = 1, .highest = 2}},
       "h", "ε", "with viim: the level of the distance from which films are reconstructed"},
      {"rearrangement.dynamics",
       choice<Case, RearrangementParameters::Dynamics>(
           {"gas", "quasistatic"},
           [](Case& c) -> RearrangementParameters::Dynamics& { return c.rearrangement.dynamics; }),
       "", "", "with the flow of the gas, or through equilibria"},
  };
}

Keys drainage_keys() {
  return {
      {"drainage.max_time", Number<Case>{[](Case& c) -> double& { return c.drainage.max_time; }}, "s", "",
       "longest duration of one stage"},
      {"drainage.tolerance",
       Number<Case>{[](Case& c) -> double& { return c.drainage.tolerance; }, positive_up_to(0.5)}, "", "",
       "relative error of η and λ in one step"},
      {"drainage.scheme",
       choice<Case, drainage::Scheme>({"positive", "paper"},
                                      [](Case& c) -> drainage::Scheme& { return c.drainage.scheme; }),
       "", "", "second order and positive, or the paper's own steps, which the tables of the paper check"},
      {"drainage.max_step", Number<Case>{[](Case& c) -> double& { return c.drainage.max_step; }}, "s", "",
       "longest time step"},
      {"drainage.edge_at_borders",
       Number<Case>{[](Case& c) -> double& { return c.meshing.edge_at_borders; }, non_negative()}, "m", "",
       "edges of the mesh at Plateau borders; 0: by the boundary layer and the grid"},
      {"drainage.edge_at_junctions",
       Number<Case>{[](Case& c) -> double& { return c.meshing.edge_at_junctions; }, non_negative()}, "m", "",
       "edges where borders meet, whose corners drain first; 0: as at borders"},
  };
}

Keys rupture_keys() {
  return {
      {"rupture.threshold", Number<Case>{[](Case& c) -> double& { return c.rupture.threshold; }}, "m", "η",
       "half-thickness at which a lamella ruptures"},
      {"rupture.criterion",
       choice<Case, rupture::Criterion>({"film", "node"},
                                        [](Case& c) -> rupture::Criterion& { return c.rupture.criterion; }),
       "", "", "film: border points near a junction do not count; node: all points count"},
      {"rupture.liquid",
       choice<Case, rupture::Fate>({"redistribute", "spray"},
                                   [](Case& c) -> rupture::Fate& { return c.rupture.liquid; }),
       "", "", "what becomes of the liquid of a torn lamella"},
      {"rupture.protect",
       PhasePairs<Case>{[](Case& c) -> std::vector<std::array<int, 2>>& { return c.rupture.protect; }}, "",
       "", "pairs of phases whose films never rupture; a bubble merged of two has the lower number"},
      {"rupture.corner_radius",
       Number<Case>{[](Case& c) -> double& { return c.rupture.corner_radius; }, non_negative()}, "m", "",
       "with criterion film: how near to a junction border points do not count"},
  };
}

Keys cycle_keys() {
  return {
      {"cycle.end_time", Number<Case>{[](Case& c) -> double& { return c.cycle.end_time; }}, "s", "t",
       "simulated time at which the run ends"},
      {"cycle.max_ruptures", WholeNumber<Case>{[](Case& c) -> int& { return c.cycle.max_ruptures; }, 0}, "",
       "", "number of ruptures after which the run ends"},
      {"cycle.stages", stages_choice(), "", "", "mechanisms that act; a subset runs one alone"},
  };
}

Keys output_keys() {
  return {
      {"output.rearrangement_interval",
       Number<Case>{[](Case& c) -> double& { return c.output.rearrangement_interval; }}, "s", "",
       "between frames while the films move"},
      {"output.drainage_interval",
       Number<Case>{[](Case& c) -> double& { return c.output.drainage_interval; }}, "s", "",
       "between frames while the films drain"},
      {"output.gas", Flag<Case>{[](Case& c) -> bool& { return c.output.gas; }}, "", "", "write gas.pvd too"},
      {"output.fields", fields_choice(), "", "", "fields of gas.pvd"},
      {"flow.elliptic",
       choice<Case, grid::EllipticBackend>({"trigonometric", "multigrid"},
                                           [](Case& c) -> grid::EllipticBackend& { return c.flow.elliptic; }),
       "", "", "solver of the pressure and viscosity equations"},
  };
}

}  // namespace

const std::vector<Section>& sections() {
  static const std::vector<Section> all{
      {"", "the case"},
      {"domain", "the box and its grid"},
      {"gas", "the gas in and around the bubbles"},
      {"liquid", "the liquid in the films"},
      {"film", "the faces of the films"},
      {"foam", "the foam at time 0; bubbles are numbered 1, 2, … in order, 0 is the outside"},
      {"foam.cluster", "bubbles placed at random that touch each other",
       [](const Case& c) { return c.foam.cluster.has_value(); }, [](Case& c) { cluster(c); }},
      {"foam.lattice", "bubbles that fill a periodic box and leave no outside",
       [](const Case& c) { return c.foam.lattice.has_value(); }, [](Case& c) { lattice(c); }},
      {"foam.labels", "bubbles from a labelled voxel image; label 0 is the outside",
       [](const Case& c) { return c.foam.labels.has_value(); }, [](Case& c) { labels(c); }},
      {"foam.membrane", "a film across the box, through periodic sides; bubbles may sit on it",
       [](const Case& c) { return c.foam.membrane.has_value(); }, [](Case& c) { membrane(c); }},
      {"foam.films", "films of a file, to drain as they are: needs no [domain] and stages [\"drain\"]",
       [](const Case& c) { return c.foam.films.has_value(); }, [](Case& c) { films(c); }},
      {"rearrangement", "bubbles and films move until they are near equilibrium"},
      {"drainage", "liquid drains from the films"},
      {"rupture", "the thinnest film breaks"},
      {"cycle", "rearrange, drain, rupture, and again"},
      {"output", "what is written and how often"},
      {"flow", "solver of the gas flow"},
  };
  return all;
}

const std::vector<Key<Case>>& case_keys() {
  static const Keys all = [] {
    Keys keys;
    for (const Keys& part :
         {box_keys(), material_keys(), foam_keys(), lattice_keys(), labels_and_membrane_keys(), films_keys(),
          rearrangement_keys(), drainage_keys(), rupture_keys(), cycle_keys(), output_keys()})
      keys.insert(keys.end(), part.begin(), part.end());
    return keys;
  }();
  return all;
}

const std::vector<Key<BubbleEntry>>& bubble_keys() {
  using Entry = BubbleEntry;
  static const std::vector<Key<Entry>> all{
      {"foam.bubble.shape",
       choice<Entry, Entry::Shape>({"sphere", "ellipsoid"},
                                   [](Entry& b) -> Entry::Shape& { return b.shape; }),
       "", "", "shape of the bubble; overlaps are shared along the power plane", true},
      {"foam.bubble.center", Vector<Entry>{[](Entry& b) -> Vec3& { return b.center; }}, "m", "", "its centre",
       true},
      {"foam.bubble.radius", Number<Entry>{[](Entry& b) -> double& { return b.radius; }}, "m", "",
       "radius of a sphere"},
      {"foam.bubble.semi_axes", Vector<Entry>{[](Entry& b) -> Vec3& { return b.semi_axes; }, positive()}, "m",
       "", "semi-axes of an ellipsoid along x, y, z"},
  };
  return all;
}

}  // namespace spume::config
