#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace pedicel::app {

struct Document;

/// What a document's files said when they were read or written last, to know whether another
/// program has changed them since.
class FileTexts {
 public:
  /// Reads the files of a document as they are now; those that cannot be read are left out.
  void remember(const Document& document);
  void remember(const std::filesystem::path& file, const std::string& text);
  /// Whether a scene or plant file says something else than it did; false where it is not there,
  /// or was never read. Comments and layout do not count.
  bool has_changed(const std::filesystem::path& file) const;
  /// What it said then; as it is now where it was never read.
  std::string known(const std::filesystem::path& file) const;

 private:
  std::map<std::filesystem::path, std::string> texts_;
};

/// The same file, whether it is there or not.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Writes it in one piece; the one before stays as NAME~. Throws io::WriteError.
void write_with_backup(const std::filesystem::path& path, const std::string& text);

}  // namespace pedicel::app
