#include "engine/cluster/campaign.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "engine/cluster/case_run.h"
#include "engine/cluster/local_queue.h"
#include "engine/cluster/slurm_queue.h"
#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"

namespace pedicel::cluster {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int most_rounds = 3;  // of handing in what got lost
// A file of another node may come into sight late.
constexpr std::chrono::seconds late_files{5};
constexpr std::size_t most_told = 10;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

std::string how_to_go_on(const RunFolder& folder) {
  return "; what is done stays, and `pedicel cluster resume " + folder.path().string() +
         "` goes on";
}

std::string stopped_text(const RunFolder& folder) {
  return "stopped" + how_to_go_on(folder);
}

void nap(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

}  // namespace

/// One shell at a time waits on a run.
struct Campaign::Lock {
  explicit Lock(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error)
      throw io::WriteError(path.parent_path().string() + ": cannot be created: " + error.message());
    file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0)
      throw io::WriteError(path.string() + ": cannot be written: " + std::strerror(errno));
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(file);
      throw UsageError(path.parent_path().string() +
                       ": another shell waits on this run, expected one at a time");
    }
  }
  ~Lock() { ::close(file); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
  int file = -1;
};

std::unique_ptr<Queue> make_queue(const RunFolder& folder, const TaskHead& head,
                                  const ClusterOptions& options) {
  if (options.mode == "slurm") return std::make_unique<SlurmQueue>(folder, head, options);
  return std::make_unique<LocalQueue>(folder, head, options);
}

Campaign::Campaign(const fs::path& folder, const Plan& plan, const ClusterOptions& options,
                   const ProgramAbout& about)
    : folder_(fs::absolute(folder).lexically_normal()),
      options_(options),
      lock_(std::make_unique<Lock>(folder_.lock())),
      tasks_(tasks_of(plan, about)),
      about_(about) {
  std::error_code error;
  bool is_new = true;
  if (fs::exists(folder_.tasks(), error)) {
    TaskFile before = read_task_file(folder_.tasks());
    is_new = !same_cases(before, tasks_);
    if (!is_new) {
      before.head.again = tasks_.head.again;
      tasks_ = std::move(before);
    } else if (SlurmQueue queue(folder_, before.head, {}); !queue.state().empty()) {
      throw UsageError(folder_.path().string() + ": " + queue.left() +
                       " is still about other cases, expected another folder (--out), or `pedicel "
                       "cluster cancel` first");
    }
  }
  if (is_new && !options.collect_only) write_task_file(folder_.tasks(), tasks_);
  surveyor_ = std::make_unique<Surveyor>(folder_, tasks_);
  survey_ = surveyor_->look(true);
}

Campaign::~Campaign() = default;

// The block's length is known once one case is. That one is done here, as a task would do it, and
// its results count.
void Campaign::measure_case(const Progress& progress, const Say& say) {
  double seconds = options_.case_seconds;
  if (seconds == 0.0 && survey_.done() > 0) seconds = survey_.seconds / survey_.done();
  if (seconds == 0.0) {
    if (progress) progress("one case, to see how long it takes", 0.0);
    InputCheck inputs(tasks_.head);
    const auto begin = Clock::now();
    const Case& one = tasks_.cases[survey_.missing.front()];
    const CaseRunOptions run{folder_, options_.mode == "slurm" ? fs::path() : options_.scratch,
                             about_.instruction_set(tasks_.head.instruction_set)};
    try {
      run_case(tasks_.head, one, inputs, run);
    } catch (const Stopped&) {
      say(stopped_text(folder_));
      throw;
    }
    seconds = seconds_since(begin);
  }
  make_blocks(tasks_, options_.block_seconds, seconds);
  write_task_file(folder_.tasks(), tasks_);
  surveyor_ = std::make_unique<Surveyor>(folder_, tasks_);
  survey_ = surveyor_->look(true);
}

void Campaign::submit(Queue& queue) {
  std::error_code error;
  for (const CaseRecord& failure : survey_.failures) fs::remove(folder_.failure(failure.id), error);
  survey_.failures.clear();
  queue.submit(missing_blocks(survey_, tasks_));
}

std::string Campaign::words(const Queue::State& state) const {
  std::string text =
      std::to_string(survey_.done()) + " of " + std::to_string(tasks_.cases.size()) + " cases";
  if (!survey_.failures.empty()) text += ", " + std::to_string(survey_.failures.size()) + " failed";
  if (!state.known) return text + " (the queue does not answer)";
  return text + ", " + std::to_string(state.running) + " tasks running, " +
         std::to_string(state.waiting) + " waiting";
}

// True: the queue is empty. False: it was stopped.
bool Campaign::wait(Queue& queue, const Progress& progress, const Say& say) {
  Clock::time_point looked{};
  double between = 0.0;  // s
  std::optional<Clock::time_point> silent;
  while (!stop_requested) {
    const Queue::State state = queue.state();
    if (state.empty()) return true;
    if (state.known) silent.reset();
    if (!state.known && !silent) {
      silent = Clock::now();
      say("the queue does not answer; waiting on");
    }
    if (seconds_since(looked) >= between) {
      const Clock::time_point begin = Clock::now();
      survey_ = surveyor_->look(false);
      // Looking is to cost little beside what is looked at.
      between = std::max(1.0, 20.0 * seconds_since(begin));
      looked = Clock::now();
      if (survey_.missing.empty()) return true;
      if (progress)
        progress(words(state),
                 static_cast<double>(survey_.done()) /
                     static_cast<double>(std::max<std::size_t>(1, tasks_.cases.size())));
    }
    for (double left = queue.interval(); left > 0.0 && !stop_requested; left -= 0.1)
      nap(std::min(left, 0.1));
  }
  return false;
}

void Campaign::interrupted(Queue& queue, const Say& say) const {
  if (queue.left().empty() || options_.on_interrupt == "cancel") {
    const std::string job = queue.left();
    queue.cancel();
    say(job.empty() ? stopped_text(folder_) : job + " is cancelled" + how_to_go_on(folder_));
  } else {
    say(queue.left() + " goes on; `pedicel cluster resume " + folder_.path().string() +
        "` waits for it again, `pedicel cluster cancel` ends it");
  }
}

void Campaign::run(const Progress& progress, const Say& say) {
  if (!options_.collect_only && !survey_.missing.empty()) {
    const std::unique_ptr<Queue> queue = make_queue(folder_, tasks_.head, options_);
    bool attached = !queue->state().empty();
    // Before a case is done here: where nothing can be handed in, its time would be lost.
    if (!attached) queue->check();
    if (tasks_.head.block_seconds == 0.0) measure_case(progress, say);
    for (int round = 0; round < most_rounds && !survey_.missing.empty(); ++round) {
      if (!attached) submit(*queue);
      attached = false;
      if (options_.no_wait) {
        say(queue->left() + ": " + std::to_string(survey_.missing.size()) +
            " cases are handed in; `pedicel cluster resume " + folder_.path().string() +
            "` waits for them and merges the results");
        return;
      }
      if (!wait(*queue, progress, say)) {
        interrupted(*queue, say);
        break;
      }
      survey_ = surveyor_->look(true);
      for (const auto begin = Clock::now(); Clock::now() - begin < late_files && !stop_requested &&
                                            options_.mode == "slurm" &&
                                            survey_.missing.size() > survey_.failures.size();) {
        nap(0.5);
        survey_ = surveyor_->look(true);
      }
      // What failed and said why fails again; what is missing without a word got lost.
      if (survey_.missing.size() == survey_.failures.size()) break;
    }
  }
  survey_ = surveyor_->look(true);
  if (survey_.missing.empty()) {
    std::error_code error;
    fs::remove_all(folder_.parts(), error);
  }
  if (const std::string fault = mixture(survey_); !fault.empty()) throw UsageError(fault);
}

std::optional<fs::path> Campaign::output(int number) const {
  if (!survey_.records[number]) return std::nullopt;
  return folder_.result(tasks_.cases[number].id) / "out";
}

std::string Campaign::missing_text() const {
  if (survey_.missing.empty()) return {};
  const std::size_t all = tasks_.cases.size();
  std::string text = std::to_string(survey_.missing.size()) + " of " + std::to_string(all) +
                     (all == 1 ? " case is missing:" : " cases are missing:");
  for (std::size_t i = 0; i < survey_.missing.size(); ++i) {
    const Case& one = tasks_.cases[survey_.missing[i]];
    if (i == most_told) {
      text += "\n  and " + std::to_string(survey_.missing.size() - i) + " more";
      break;
    }
    const auto said = std::ranges::find(survey_.failures, one.id, &CaseRecord::id);
    text += "\n  " + one.name + ": " +
            (said == survey_.failures.end() ? "no word of it, see " + folder_.logs().string()
                                            : said->reason + " (on " + said->host + ")");
  }
  return text;
}

}  // namespace pedicel::cluster
