#include "spume/verification/oscillation.hpp"

#include <gtest/gtest.h>

namespace spume::verification {
namespace {

// By mpmath with 30 digits: the amplitude as the residues of the normal mode and an integral along the cut of
// its transform, at 401 times, and Newton's method for the fit.
TEST(Oscillation, FitsTheExactSolutionFromRest) {
  const Decay fit = fit_exact({.mode = 2, .viscosity = 0.05});
  EXPECT_NEAR(fit.omega, 1.8887275, 1e-6);
  EXPECT_NEAR(fit.gamma, 0.37009492, 1e-6);
}

}  // namespace
}  // namespace spume::verification
