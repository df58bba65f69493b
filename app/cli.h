#pragma once

namespace pedicel::app {

/// The whole program: reads the command line, does what it says, returns the exit code
/// (0 ok, 1 runtime failure, 2 usage, 3 a file is invalid or missing, 4 the simulation is unstable,
/// 5 an expectation is not met, 6 output cannot be written, 77 pictures were asked for and there is
/// no OpenGL, 130 stopped by the user).
int run_cli(int argc, char** argv);

}  // namespace pedicel::app
