#include "engine/io/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <sstream>
#include <string_view>

#include "engine/io/atomic_file.h"
#include "engine/io/output_check.h"
#include "engine/io/output_kind.h"

namespace pedicel::io {

namespace fs = std::filesystem;

namespace {

constexpr const char* list_name = ".pedicel-files";
constexpr const char* list_head =
    "# What a run wrote here. The next run into this folder takes these files away, and no "
    "others.\n";

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw WriteError(path.string() + ": " + what);
}

std::string reason() {
  return std::strerror(errno);
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    paths.push_back(entry->path());
  return paths;
}

/// The lines of a list that name something in its own folder.
std::vector<std::string> lines_of(int list) {
  std::string text;
  std::array<char, 4096> some{};
  ::lseek(list, 0, SEEK_SET);
  for (ssize_t n; (n = ::read(list, some.data(), some.size())) > 0;)
    text.append(some.data(), static_cast<std::size_t>(n));
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const fs::path path = line;
    const bool inside =
        path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
    if (!line.empty() && line[0] != '#' && inside) lines.push_back(line);
  }
  return lines;
}

std::string time_of(int file) {
  struct stat about {};
  std::tm local{};
  std::array<char, 32> text{};
  if (::fstat(file, &about) != 0 || !::localtime_r(&about.st_mtime, &local)) return "before";
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &local);
  return text.data();
}

bool are_digits(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// "frame_00012.png"
bool is_numbered_picture(const std::string& name) {
  constexpr std::string_view before = "frame_", after = ".png";
  return name.size() > before.size() + after.size() && name.starts_with(before) &&
         name.ends_with(after) &&
         are_digits(std::string_view(name).substr(before.size(),
                                                  name.size() - before.size() - after.size()));
}

/// What a writer that was killed left of a file: "log.csv.part1234", "run.mp4.part".
bool is_part_of(const std::string& name, const std::string& file) {
  constexpr std::string_view part = ".part";
  return name.starts_with(file + std::string(part)) &&
         are_digits(std::string_view(name).substr(file.size() + part.size()));
}

/// How many files; of a folder its numbered pictures, or what its own list names.
long remove_listed(const fs::path& folder, const std::vector<std::string>& lines);

long remove_own_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_symlink(folder, error) || !fs::is_directory(folder, error)) return 0;
  long removed = 0;
  const fs::path list = folder / list_name;
  if (const int file = ::open(list.c_str(), O_RDONLY | O_CLOEXEC); file >= 0) {
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) {
      removed += remove_listed(folder, lines_of(file));
      fs::remove(list, error);
    }
    ::close(file);
  }
  for (const fs::path& path : entries_of(folder))
    if (is_numbered_picture(path.filename().string())) removed += fs::remove(path, error);
  if (fs::is_empty(folder, error)) fs::remove(folder, error);
  return removed;
}

long remove_listed(const fs::path& folder, const std::vector<std::string>& lines) {
  std::error_code error;
  long removed = 0;
  for (const std::string& line : lines) {
    const fs::path path = folder / line;
    if (line.back() == '/')
      removed += remove_own_folder(path.parent_path());
    else if (!fs::is_directory(path, error))
      removed += fs::remove(path, error);
    // With the folders that are empty then.
    for (fs::path above = fs::path(line).parent_path(); !above.empty(); above = above.parent_path())
      if (!fs::is_empty(folder / above, error) || !fs::remove(folder / above, error)) break;
  }
  for (const fs::path& path : entries_of(folder))
    for (const std::string& line : lines)
      if (is_part_of(path.filename().string(), line)) removed += fs::remove(path, error);
  return removed;
}

constexpr const char* taken_by_another =
    "another run is writing there, expected another folder (--out)";

void check_is_free(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (name.ends_with('/')) return;  // its files are asked for one by one
  if (fs::exists(fs::symlink_status(folder / name, error)))
    fail(folder / name,
         "is there, and no list says that a run wrote it: expected another folder (--out), or this "
         "one without it");
}

/// Before anything is taken away: what is there may only be what an earlier run wrote.
void check_all_free(const fs::path& folder, const std::vector<std::string>& names,
                    const std::vector<std::string>& earlier) {
  for (const std::string& name : names)
    if (std::ranges::find(earlier, name) == earlier.end()) check_is_free(folder, name);
}

}  // namespace

void check_output_folder(const fs::path& folder, const std::vector<std::string>& names) {
  std::error_code error;
  const fs::file_status there = fs::status(folder, error);
  if (error && there.type() != fs::file_type::not_found)
    fail(folder, "cannot be created: " + error.message());
  if (fs::exists(there) && !fs::is_directory(there))
    fail(folder, std::string("cannot be created: ") + std::strerror(ENOTDIR));
  check_place_for_files(folder);
  const int list = ::open((folder / list_name).c_str(), O_RDONLY | O_CLOEXEC);
  if (list < 0) return check_all_free(folder, names, {});
  const bool taken = ::flock(list, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  const std::vector<std::string> earlier = lines_of(list);
  ::close(list);
  if (taken) fail(folder, taken_by_another);
  check_all_free(folder, names, earlier);
}

bool is_file_of_a_run(const fs::path& folder, const std::string& name) {
  const int list = ::open((folder / list_name).c_str(), O_RDONLY | O_CLOEXEC);
  if (list < 0) return false;
  const std::vector<std::string> lines = lines_of(list);
  ::close(list);
  return std::ranges::find(lines, name) != lines.end();
}

OutputFolder::OutputFolder(fs::path folder, const std::vector<std::string>& names)
    : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) fail(folder_, "cannot be created: " + error.message());
  const fs::path list = folder_ / list_name;
  list_ = ::open(list.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (list_ < 0) fail(folder_, "cannot be written to: " + reason());
  try {
    if (::flock(list_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      fail(folder_, taken_by_another);
    check_all_free(folder_, names, lines_of(list_));
    remove_earlier_run();
    append(list_head);
  } catch (...) {
    ::close(list_);
    throw;
  }
}

OutputFolder::~OutputFolder() {
  ::close(list_);
}

fs::path OutputFolder::file(const std::string& name) {
  if (own_.count(name) == 0) {
    check_free(name);
    append(name + "\n");
    own_.insert(name);
  }
  return folder_ / (name.ends_with('/') ? name.substr(0, name.size() - 1) : name);
}

void OutputFolder::remove_earlier_run() {
  const std::vector<std::string> lines = lines_of(list_);
  const std::string when = time_of(list_);
  if (const long removed = remove_listed(folder_, lines); removed > 0)
    replaced_ = folder_.string() + ": replaces the run of " + when + " (" +
                std::to_string(removed) + (removed == 1 ? " file)" : " files)");
  if (::ftruncate(list_, 0) != 0) fail(folder_, "cannot be written to: " + reason());
}

void OutputFolder::check_free(const std::string& name) const {
  check_is_free(folder_, name);
}

void OutputFolder::append(const std::string& line) {
  const ssize_t n = ::write(list_, line.data(), line.size());
  if (n != static_cast<ssize_t>(line.size()))
    fail(folder_, "cannot be written to: " + (n < 0 ? reason() : std::strerror(ENOSPC)));
}

namespace {

/// A folder beside another one, gone when this is.
class StagingFolder {
 public:
  explicit StagingFolder(const fs::path& target) {
    const fs::path whole = fs::absolute(target).lexically_normal();
    const fs::path named = whole.has_filename() ? whole : whole.parent_path();
    folder = named.string() + ".part" + std::to_string(::getpid());
    std::error_code error;
    fs::remove_all(folder, error);
    fs::create_directories(folder, error);
    if (error) fail(target, "cannot be created: " + error.message());
  }
  ~StagingFolder() {
    std::error_code error;
    if (!keep) fs::remove_all(folder, error);
  }
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (!entry.is_directory())
        names.push_back(entry.path().lexically_relative(folder).generic_string());
    return names;
  }

  fs::path folder;
  bool keep = false;
};

}  // namespace

std::string write_folder(const fs::path& folder,
                         const std::function<void(const fs::path&)>& write) {
  check_output_folder(folder);
  StagingFolder staged(folder);
  write(staged.folder);
  const std::vector<std::string> names = staged.files();
  try {
    OutputFolder output(folder, names);
    for (const std::string& name : names) {
      std::error_code error;
      const fs::path target = output.file(name);
      fs::create_directories(target.parent_path(), error);
      if (!error) fs::rename(staged.folder / name, target, error);
      if (error) fail(target, "cannot be written: " + error.message());
    }
    return output.replaced();
  } catch (const WriteError& fault) {
    staged.keep = true;  // it may have taken hours
    throw WriteError(std::string(fault.what()) + "; what was to go there is in " +
                     staged.folder.string());
  }
}

std::string name_of_file(const fs::path& path) {
  const std::string name = path.filename().string();
  // A folder of dots alone is one above, or none of its own.
  const auto is_dots = [](std::string_view text) { return text == "." || text == ".."; };
  if (is_dots(name)) return "untitled";
  for (const std::string ending :
       {".scene.yaml", ".plant.yaml", ".leaf.yaml", ".yaml", ".yml", ".csv", ".mtg"})
    if (name.size() > ending.size() && name.ends_with(ending) &&
        !is_dots(std::string_view(name).substr(0, name.size() - ending.size())))
      return name.substr(0, name.size() - ending.size());
  return name;
}

}  // namespace pedicel::io
