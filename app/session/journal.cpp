#include "app/session/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstring>

#include "app/session/commands/command.h"
#include "app/session/commands/scene_things.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_writer.h"

namespace pedicel::app {

namespace {

constexpr const char* first_line = "# pedicel journal 1";
constexpr const char* ending = ".journal";

/// One a process and millisecond.
std::string unique_name() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(now).count()) + "_" +
         std::to_string(getpid()) + ending;
}

/// A plant without stems is no plant file yet.
std::string empty_plant_text(const DocumentPlant& one) {
  const auto line = [](const Command& command) { return command.text() + "\n"; };
  const plant::PlantFile& file = *one.file;
  const std::string& name = one.entry.name;
  const auto numbers = [&](const char* verb, const auto& keys, const auto& of) {
    std::string lines;
    for (const auto& key : keys)
      if (const auto value = plant::number_of(of, key))
        lines += line(
            Command(verb, {{"plant", name}, {"key", std::string(key.name)}, {"value", *value}}));
    return lines;
  };
  return line(Command("new plant", {{"plant", name},
                                    {"position", one.entry.pose.position},
                                    {"turn", turn_numbers(one.entry.pose.rotation)}})) +
         numbers("set material", plant::material_keys, file.material) +
         numbers("set sampling", plant::sampling_keys, file);
}

/// The scene without what is recorded; of its plants only the names, since it speaks of them.
std::string scene_line(const Document& document) {
  world::Scene scene = *document.scene;
  if (scene.robot) scene.robot->recorded.clear();
  scene.plants.clear();
  for (const DocumentPlant& one : document.plants) {
    world::ScenePlant& plant = scene.plants.emplace_back();
    plant.name = one.entry.name;
    plant.source = world::ScenePlant::Source::built_in;
    plant.built_in = "none";
  }
  return Command("set scene", {{"text", world::scene_text(scene, {})}}).text() + "\n";
}

std::string base_text(const Document& document) {
  return std::string(first_line) + "\n# document " +
         (document.path.empty() ? std::string()
                                : std::filesystem::absolute(document.path).string()) +
         "\n" + state_commands(document) + "# base\n";
}

}  // namespace

// Plants that the document's file does not say itself are added; the others are set.
std::string state_commands(const Document& document) {
  std::string text = scene_line(document);
  for (const DocumentPlant& one : document.plants) {
    if (one.file && one.file->curves.empty()) text += empty_plant_text(one);
    if (!one.file || one.file->curves.empty()) continue;
    text += Command("set plant", {{"plant", one.entry.name},
                                  {"text", plant::plant_text(*one.file)},
                                  {"position", one.entry.pose.position},
                                  {"turn", turn_numbers(one.entry.pose.rotation)}})
                .text() +
            "\n";
  }
  for (const auto& [key, value] : document.settings)
    text += Command("set", {{"key", key}, {"value", value}}).text() + "\n";
  for (const RobotWaypoint& one : document.waypoints)
    text += Command("add waypoint", {{"time", one.time}, {"joints", one.joints}}).text() + "\n";
  return text;
}

Journal::Journal(std::filesystem::path folder)
    : folder_(std::move(folder)), file_(folder_ / unique_name()) {}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::begin(const Document& document) {
  io::write_file_atomically(file_, base_text(document));
  open();
}

void Journal::open() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0)
    throw io::WriteError(file_.string() + ": cannot be opened: " + std::strerror(errno));
  flock(descriptor_, LOCK_EX | LOCK_NB);
}

void Journal::add(const std::string& command, std::uint64_t hash) {
  char tail[24];
  std::snprintf(tail, sizeof tail, " #%016" PRIx64 "\n", hash);
  const std::string line = command + tail;
  std::size_t done = 0;
  while (done < line.size()) {
    const ssize_t now = ::write(descriptor_, line.data() + done, line.size() - done);
    if (now < 0 && errno == EINTR) continue;
    if (now <= 0)
      throw io::WriteError(file_.string() + ": cannot be written: " + std::strerror(errno));
    done += static_cast<std::size_t>(now);
  }
  ::fdatasync(descriptor_);
}

void Journal::close() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  descriptor_ = -1;
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

JournalContent read_journal(const std::filesystem::path& file) {
  const std::string text = io::read_file(file);
  JournalContent content;
  bool in_base = true;
  int number = 0;
  for (std::size_t start = 0, end; (end = text.find('\n', start)) != std::string::npos;
       start = end + 1) {
    const std::string line = text.substr(start, end - start);
    if (++number == 1 && line != first_line)
      throw InvalidFile({file.string(), 1, 1},
                        "no journal, expected \"" + std::string(first_line) + "\"");
    if (line == "# base") {
      in_base = false;
    } else if (line.rfind("# document ", 0) == 0) {
      content.document = line.substr(11);
    } else if (in_base && line.front() != '#') {
      content.base.push_back({line, {}});
    } else if (!in_base) {
      const std::size_t mark = line.rfind(" #");
      std::uint64_t hash = 0;
      if (mark == std::string::npos || std::sscanf(line.c_str() + mark, " #%" SCNx64, &hash) != 1)
        continue;
      content.commands.push_back({line.substr(0, mark), hash});
    }
  }
  if (number == 0) throw InvalidFile({file.string(), 1, 1}, "empty, expected a journal");
  return content;
}

std::vector<std::filesystem::path> lost_journals(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() != ending) continue;
    const int descriptor = ::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (flock(descriptor, LOCK_SH | LOCK_NB) == 0) found.push_back(entry.path());
    ::close(descriptor);
  }
  std::sort(found.rbegin(), found.rend());
  return found;
}

}  // namespace pedicel::app
