#pragma once

#include <string>
#include <vector>

namespace pedicel::cluster {

/// Where blocks are handed in to be done.
class Queue {
 public:
  struct State {
    bool known = true;  ///< false: it does not answer just now
    int running = 0, waiting = 0;
    bool empty() const { return known && running == 0 && waiting == 0; }
  };

  virtual ~Queue() = default;
  /// Throws std::runtime_error where nothing can be handed in from here, with what was expected.
  virtual void check() = 0;
  /// Throws std::runtime_error where it refuses.
  virtual void submit(const std::vector<int>& blocks) = 0;
  virtual State state() = 0;
  virtual void cancel() = 0;
  /// What is to be said where the run is left to go on: "job 123"; empty: it does not go on.
  virtual std::string left() const = 0;
  /// s between two looks at it.
  virtual double interval() const = 0;
};

}  // namespace pedicel::cluster
