// Catch2's implementation, which takes longer to compile than any test: once for the programs with and
// without MPI.
#define CATCH_CONFIG_RUNNER
#include "catch_session.h"

#include <catch2/catch.hpp>

int run_tests(int argc, char** argv) {
  return Catch::Session().run(argc, argv);
}
