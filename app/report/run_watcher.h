#pragma once

#include <functional>
#include <memory>

namespace pedicel::simulation {
class Simulation;
}  // namespace pedicel::simulation

namespace pedicel::app {

class PictureTaker;

/// Looks at a run as it goes: a log of another kind, somebody who listens. It may throw
/// io::WriteError, which ends the run.
class RunWatcher {
 public:
  virtual ~RunWatcher() = default;
  virtual void begin() = 0;  ///< before the first step
  virtual void after_step() = 0;
  virtual void end() = 0;  ///< after the last step, also of a run that is stopped
};

/// Makes one for a run; simulation and taker outlive it. The taker is null where the run takes no
/// pictures.
using MakeWatcher =
    std::function<std::unique_ptr<RunWatcher>(simulation::Simulation&, PictureTaker*)>;

}  // namespace pedicel::app
