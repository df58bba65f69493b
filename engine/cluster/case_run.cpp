#include "engine/cluster/case_run.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "engine/cluster/build_id.h"
#include "engine/cluster/process.h"
#include "engine/cluster/sha256.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"

namespace pedicel::cluster {

namespace {

namespace fs = std::filesystem;

std::string time_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  std::array<char, 32> text{};
  ::gmtime_r(&now, &utc);
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// "123_4" within an array of Slurm.
std::string job_of_here() {
  const std::string array = environment("SLURM_ARRAY_JOB_ID");
  if (!array.empty()) return array + "_" + environment("SLURM_ARRAY_TASK_ID");
  return environment("SLURM_JOB_ID");
}

[[noreturn]] void cannot_write(const fs::path& path, const std::string& reason) {
  throw io::WriteError(path.string() + ": cannot be written: " + reason);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw io::WriteError(folder.string() + ": cannot be created: " + error.message());
}

/// To disk: a rename is no promise about what the file holds.
void sync(const fs::path& path, int flags) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (file < 0) cannot_write(path, std::strerror(errno));
  const int failed = ::fsync(file);
  const int reason = errno;
  ::close(file);
  if (failed != 0) cannot_write(path, std::strerror(reason));
}

void sync_tree(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_symlink()) continue;
    if (entry.is_regular_file()) sync(entry.path(), 0);
    if (entry.is_directory()) sync(entry.path(), O_DIRECTORY);
  }
  sync(folder, O_DIRECTORY);
}

/// A folder that is gone when this is, unless it was renamed.
class Part {
 public:
  explicit Part(fs::path folder) : folder_(std::move(folder)) {
    std::error_code error;
    fs::remove_all(folder_, error);
    make_folder(folder_);
  }
  ~Part() {
    std::error_code error;
    fs::remove_all(folder_, error);
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
  const fs::path& path() const { return folder_; }

 private:
  fs::path folder_;
};

std::string part_name(const std::string& id) {
  return id + "." + host_name() + "." + std::to_string(::getpid());
}

/// Under the final name, at once. Where another task was quicker, its results stay: they are the
/// same.
void place(const fs::path& part, const fs::path& result) {
  make_folder(result.parent_path());
  std::error_code error;
  fs::rename(part, result, error);
  if (error && !fs::exists(result / "record.json")) cannot_write(result, error.message());
  sync(result.parent_path(), O_DIRECTORY);
}

std::vector<std::string> command_of(const TaskHead& head, const Case& one, const fs::path& out) {
  std::vector<std::string> words{head.file.string()};
  for (const std::vector<std::string>* list : {&head.common, &one.arguments})
    for (std::string word : *list) {
      for (std::size_t at = 0; (at = word.find(out_mark, at)) != std::string::npos;) {
        word.replace(at, out_mark.size(), out.string());
        at += out.string().size();
      }
      words.push_back(word);
    }
  return words;
}

CaseRecord record_of(const TaskHead& head, const Case& one, const CaseRunOptions& options) {
  CaseRecord record;
  record.id = one.id;
  record.name = one.name;
  record.program = head.program;
  record.instruction_set = options.instruction_set;
  record.math = math_level();
  record.host = host_name();
  record.job = job_of_here();
  record.restarts = std::atoi(environment("SLURM_RESTART_COUNT").c_str());
  return record;
}

bool is_result(const TaskHead& head, int exit_code) {
  return std::find(head.results.begin(), head.results.end(), exit_code) != head.results.end();
}

std::string why(int exit_code, const std::string& errors) {
  const std::string words = last_line(errors);
  if (exit_code > 128 && words.empty())
    return "ended by signal " + std::to_string(exit_code - 128) + " (" +
           ::strsignal(exit_code - 128) + ")";
  return words.empty() ? "exit code " + std::to_string(exit_code) : words;
}

/// The case's own program, then what it left under its final name. Sets `record`.
void make_results(const TaskHead& head, const Case& one, const CaseRunOptions& options,
                  CaseRecord& record) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string name = part_name(one.id);
  const Part part((options.scratch.empty() ? options.folder.parts() : options.scratch) / name);
  const fs::path out = part.path() / "out";
  make_folder(out);
  Process process(command_of(head, one, out), {head.folder, {}, false});
  record.exit_code = process.wait();
  throw_if_stopped();
  if (!is_result(head, record.exit_code)) {
    record.reason = why(record.exit_code, process.errors());
    return;
  }
  record.ended = time_now();
  const auto now = std::chrono::steady_clock::now();
  record.seconds = std::chrono::duration<double>(now - begin).count();
  io::write_file_atomically(part.path() / "record.json", to_json(record) + "\n");
  if (options.scratch.empty()) {
    sync_tree(part.path());
    return place(part.path(), options.folder.result(one.id));
  }
  const Part copy(options.folder.parts() / name);
  std::error_code error;
  fs::copy(part.path(), copy.path(), fs::copy_options::recursive, error);
  if (error) cannot_write(copy.path(), error.message());
  sync_tree(copy.path());
  place(copy.path(), options.folder.result(one.id));
}

void write_failure(const RunFolder& folder, const CaseRecord& record) {
  try {
    io::write_file_atomically(folder.failure(record.id), to_json(record) + "\n");
  } catch (const io::WriteError&) {
    // The disk is full: the task says it on standard error, and the case is missing.
  }
}

}  // namespace

std::string InputCheck::fault() {
  for (const Input& input : head_.inputs) {
    const fs::path path = head_.folder / input.path;
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) return path.string() + ": cannot be read: " + error.message();
    const fs::file_time_type time = fs::last_write_time(path, error);
    Seen& seen = seen_[input.path];
    if (seen.sha256.empty() || seen.size != size || seen.time != time) {
      try {
        seen = {size, time, sha256_of_file(path)};
      } catch (const InvalidFile& unreadable) {
        return unreadable.what();
      }
    }
    if (seen.sha256 != input.sha256)
      return path.string() +
             ": is not what it was when the task file was written, expected no change until all "
             "cases are done (the same call again writes a new task file)";
  }
  return {};
}

std::optional<CaseRecord> finished(const RunFolder& folder, const std::string& id) {
  const fs::path file = folder.result(id) / "record.json";
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  return parse_record(io::read_file(file), file.string());
}

CaseRecord run_case(const TaskHead& head, const Case& one, InputCheck& inputs,
                    const CaseRunOptions& options) {
  if (auto there = finished(options.folder, one.id)) return *there;
  CaseRecord record = record_of(head, one, options);
  record.reason = inputs.fault();
  record.exit_code = record.reason.empty() ? 0 : 1;
  if (record.reason.empty()) {
    try {
      make_results(head, one, options, record);
    } catch (const io::WriteError& error) {
      record.exit_code = 6;
      record.reason = error.what();
    } catch (const fs::filesystem_error& error) {
      record.exit_code = 6;
      record.reason = error.what();
    }
  }
  std::error_code ignored;
  if (record.reason.empty()) {
    fs::remove(options.folder.failure(one.id), ignored);
  } else {
    record.ended = time_now();
    write_failure(options.folder, record);
  }
  return record;
}

}  // namespace pedicel::cluster
