#pragma once

#include "spume/verification/study.hpp"

/// The studies themselves, one function each; studies.cpp says what they are.
namespace spume::verification {

using StudyRun = void(const parallel::Communicator&, Scale, Report&);

StudyRun static_currents;
StudyRun oscillating_bubble;
StudyRun reconstruction;
StudyRun quasistatic;
StudyRun double_bubble;
StudyRun unequal_double_bubble;
StudyRun triple_bubble;
StudyRun tetrahedral_cluster;
StudyRun equilibrium_convergence;
StudyRun reconstruction_damping;
StudyRun capillary_wave;
StudyRun bubble_volumes;
StudyRun robustness;
StudyRun fig12_area;
StudyRun fig13_oscillation;
StudyRun taylor_green;
StudyRun crystals;
StudyRun interface_methods;
StudyRun film_modes_flat;
StudyRun film_modes_sphere;
StudyRun film_modes_cylinder;
StudyRun vertical_film;
StudyRun spherical_film;
StudyRun border_front;
StudyRun border_hydrostatic;
StudyRun film_rim;
StudyRun film_corner;
StudyRun fig15_drainage;
StudyRun film_meshes;
StudyRun drainage_cost;
StudyRun border_table3;
StudyRun border_table4;
StudyRun lamella_table1;
StudyRun lamella_table2;
StudyRun liquid_transport;

}  // namespace spume::verification
