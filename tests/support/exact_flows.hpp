#pragma once

#include "spume/verification/exact_flows.hpp"

/// The exact flows of spume/verification, under the name that the tests use.
namespace spume::testing {
using verification::beltrami;
using verification::ExactFlow;
using verification::scalar_error;
using verification::set_velocity;
using verification::taylor_green;
using verification::velocity_error;
}  // namespace spume::testing
