#include "app/session/document/file_texts.h"

#include "app/session/document/document.h"
#include "app/session/document/scene_save.h"
#include "engine/core/diagnostics.h"
#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

std::filesystem::path key_of(const std::filesystem::path& file) {
  std::error_code none;
  const auto real = std::filesystem::weakly_canonical(file, none);
  return none ? std::filesystem::absolute(file).lexically_normal() : real;
}

bool is_same_plant(const std::string& a, const std::string& b) {
  Diagnostics diagnostics;
  const auto one = plant::parse_plant(a, "plant", diagnostics);
  const auto other = plant::parse_plant(b, "plant", diagnostics);
  return one && other && *one == *other;
}

bool is_there(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::is_regular_file(file, none);
}

}  // namespace

void FileTexts::remember(const Document& document) {
  const auto add = [&](const std::filesystem::path& file) {
    if (is_there(file)) remember(file, io::read_file(file));
  };
  add(document.path);
  for (const DocumentPlant& one : document.plants) add(one.entry.file);
}

void FileTexts::remember(const std::filesystem::path& file, const std::string& text) {
  texts_[key_of(file)] = text;
}

bool FileTexts::has_changed(const std::filesystem::path& file) const {
  const auto known = texts_.find(key_of(file));
  if (known == texts_.end() || !is_there(file)) return false;
  const std::string now = io::read_file(file);
  if (now == known->second) return false;
  return is_scene(file) ? !is_same_scene(now, known->second, file)
                        : !is_same_plant(now, known->second);
}

std::string FileTexts::known(const std::filesystem::path& file) const {
  const auto known = texts_.find(key_of(file));
  return known == texts_.end() ? io::read_file(file) : known->second;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  return !a.empty() && !b.empty() && key_of(a) == key_of(b);
}

void write_with_backup(const std::filesystem::path& path, const std::string& text) {
  if (is_there(path)) {
    std::filesystem::path backup = path;
    backup += "~";
    io::write_file_atomically(backup, io::read_file(path));
  }
  io::write_file_atomically(path, text);
}

}  // namespace pedicel::app
