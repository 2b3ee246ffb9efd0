#pragma once

// Runs the test cases that are linked in, with Catch2's command line; returns what main should.
int run_tests(int argc, char** argv);
