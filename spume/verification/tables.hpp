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

}  // namespace spume::verification
