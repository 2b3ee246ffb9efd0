// main of the Catch2 programs that need no MPI.
#include "catch_session.h"

int main(int argc, char** argv) {
  return run_tests(argc, argv);
}
