#pragma once

#include <atomic>
#include <stdexcept>

namespace pedicel {

/// Whether the program was asked to stop. Set by a signal handler; loops that may take longer than
/// a tenth of a second look at it.
extern std::atomic<bool> stop_requested;

/// Thrown by what was asked to stop before it had a result.
class Stopped : public std::runtime_error {
 public:
  Stopped();
};

/// Throws Stopped where stop_requested. For the loops of loading, building and settling; not for
/// tasks of a ThreadPool, which must not throw: those return, and their caller throws.
void throw_if_stopped();

/// 128 plus the signal that asked to stop, as shells have it: 130 Ctrl-C (SIGINT), 143 SIGTERM, 129
/// SIGHUP, 152 SIGXCPU, 141 SIGPIPE. 130 where no signal did.
int stop_exit_code();

/// From now on SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGPIPE end the program with that exit code: at
/// once, until stop_in_good_order(). A SIGHUP that is ignored (nohup) stays so.
void hear_stop_signals();

/// To be called before output is begun that must be ended in good order: from now on the first
/// signal sets stop_requested, and whoever writes ends its files. A second one, a tenth of a second
/// later or more, ends the program at once; one of SIGXCPU and SIGPIPE, which come in numbers, does
/// not.
void stop_in_good_order();

}  // namespace pedicel
