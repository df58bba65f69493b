#pragma once

#include <utility>
#include <vector>

#include "app/topics/topic_sink.h"

namespace pedicel::app {

/// What is told goes to two sinks, so that it is made once: a run that is heard and logged.
class BothSinks : public TopicSink {
 public:
  /// Both must outlive it.
  BothSinks(TopicSink& first, TopicSink& second) : first_(first), second_(second) {}

  int add(const Topic& topic) override {
    numbers_.emplace_back(first_.add(topic), second_.add(topic));
    return static_cast<int>(numbers_.size()) - 1;
  }
  void write(int topic, double time, std::string_view cdr) override {
    const auto& [first, second] = numbers_[static_cast<std::size_t>(topic)];
    first_.write(first, time, cdr);
    second_.write(second, time, cdr);
  }
  void flush() override {
    first_.flush();
    second_.flush();
  }

 private:
  TopicSink &first_, &second_;
  std::vector<std::pair<int, int>> numbers_;
};

}  // namespace pedicel::app
