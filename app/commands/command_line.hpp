#pragma once

namespace boresight::app {

/// The program: parses the arguments, runs one command, prints its report. Exit codes: 0 done,
/// 1 internal error, 2 bad input or arguments, 3 goals infeasible, 4 numerical failure, 130
/// interrupted (what was whole by then is reported).
int run_command_line(int argc, char** argv);

}  // namespace boresight::app
