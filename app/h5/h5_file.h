#pragma once

#include <hdf5.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pedicel::app {

/// An HDF5 file whose data sets grow along their first axis. Throws io::WriteError where it cannot
/// be written.
class H5File {
 public:
  explicit H5File(const std::filesystem::path& path);
  ~H5File();
  H5File(const H5File&) = delete;
  H5File& operator=(const H5File&) = delete;

  enum class Kind { number, single, byte, word };  ///< float64, float32, uint8, uint16
  /// One row more of a data set, which the first row makes; groups on the way are made, too.
  /// `shape`: of a row, the same each time; empty: a number.
  void append(const std::string& path, Kind kind, const std::vector<hsize_t>& shape,
              const void* row);
  void append(const std::string& path, double value) { append(path, Kind::number, {}, &value); }
  void append(const std::string& path, const std::vector<double>& row);
  void append_text(const std::string& path, const std::string& text);

  /// Of a group or of the file ("/"), once; later calls do nothing.
  void set_attribute(const std::string& path, const std::string& name, const std::string& text);
  void set_attribute(const std::string& path, const std::string& name,
                     const std::vector<std::string>& texts);
  /// Writes what was gathered. Nothing may be appended any more.
  void close();

 private:
  struct Series {
    hid_t set = -1, type = -1;
    std::vector<hsize_t> shape;
    std::size_t row_bytes = 0;
    hsize_t rows = 0;  // that are in the file
    std::string gathered;
  };
  [[noreturn]] void fail() const;
  hid_t good(hid_t id) const;
  Series& series(const std::string& path, hid_t type, const std::vector<hsize_t>& shape);
  void write(Series& one);
  void write_rows(Series& one, hsize_t rows, const void* data);
  hid_t group(const std::string& path);
  void set(const std::string& path, const std::string& name, hid_t space, const void* data);

  std::string name_;
  hid_t file_ = -1, text_ = -1, with_groups_ = -1;
  std::map<std::string, Series> all_;
};

}  // namespace pedicel::app
