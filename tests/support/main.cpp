#include <gtest/gtest.h>

#include "spume/parallel/session.hpp"

// Runs the tests on every rank; a failure on any rank is a failure of the process there, which mpirun
// reports.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  spume::parallel::Session session(argc, argv);
  return RUN_ALL_TESTS();
}
