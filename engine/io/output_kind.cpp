#include "engine/io/output_kind.h"

#include <algorithm>
#include <fstream>
#include <string>

#include "engine/io/atomic_file.h"
#include "engine/io/output_check.h"

namespace pedicel::io {

namespace fs = std::filesystem;

namespace {

/// The first bytes of a file; a header with thousands of columns is within.
std::string head_of(const fs::path& path) {
  std::string head(std::size_t{1} << 20, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}

bool is_of_kind(std::string_view head, OutputKind kind) {
  const std::string_view first = head.substr(0, head.find('\n'));
  switch (kind) {
    case OutputKind::log:
      // A trajectory or a table of sensors begins so, too, but counts no breaks.
      return first.starts_with("time_s,") && first.find(",detached_1") != std::string_view::npos;
    case OutputKind::events:
      return first.starts_with("time_s,organ,cause");
    case OutputKind::state:
      return first == "format: pedicel-state";
    case OutputKind::mcap:
      return head.starts_with("\x89MCAP");
    case OutputKind::hdf5:
      return head.starts_with("\x89HDF");
    case OutputKind::gltf:
      return head.starts_with("glTF");
    case OutputKind::picture:
      return head.starts_with("\x89PNG");
    case OutputKind::film:
      return head.substr(std::min<std::size_t>(4, head.size())).starts_with("ftyp");
    case OutputKind::page:
      return first.starts_with("<!doctype html") || first.starts_with("<!DOCTYPE html");
  }
  return false;
}

const char* name_of(OutputKind kind) {
  switch (kind) {
    case OutputKind::log:
      return "a log of a run";
    case OutputKind::events:
      return "a table of events";
    case OutputKind::state:
      return "a saved state";
    case OutputKind::mcap:
      return "an MCAP log";
    case OutputKind::hdf5:
      return "an HDF5 log";
    case OutputKind::gltf:
      return "a scene in glTF";
    case OutputKind::picture:
      return "a picture (PNG)";
    case OutputKind::film:
      return "a film (MP4)";
    case OutputKind::page:
      return "a page (HTML)";
  }
  return "";
}

bool is_same_folder(const fs::path& one, const fs::path& other) {
  std::error_code none;
  return fs::weakly_canonical(fs::absolute(one), none) ==
         fs::weakly_canonical(fs::absolute(other), none);
}

}  // namespace

void check_output_file(const fs::path& path, OutputKind kind, const fs::path& own) {
  check_output_file(path);
  std::error_code error;
  if (!fs::exists(path, error)) return;
  const fs::path folder = fs::absolute(path).parent_path();
  if (!own.empty() && is_same_folder(folder, own)) return;  // OutputFolder looks there
  if (is_file_of_a_run(folder, path.filename().string()))
    throw WriteError(path.string() +
                     ": is there, and is of the run in its folder, expected another name");
  const std::string head = head_of(path);
  if (!head.empty() && !is_of_kind(head, kind))
    throw WriteError(path.string() + ": is there, and is not " + name_of(kind) +
                     ", expected another name, or this file moved away");
}

OutputKind kind_of_name(std::string_view name, OutputKind otherwise) {
  if (name.ends_with(".mcap")) return OutputKind::mcap;
  if (name.ends_with(".h5")) return OutputKind::hdf5;
  if (name.ends_with(".glb")) return OutputKind::gltf;
  if (name.ends_with(".png")) return OutputKind::picture;
  if (name.ends_with(".mp4")) return OutputKind::film;
  if (name.ends_with(".html")) return OutputKind::page;
  return otherwise;
}

}  // namespace pedicel::io
