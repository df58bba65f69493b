#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/discrepancy/import/c3d_bytes.h"

namespace pedicel::discrepancy {

/// A parameter of a C3D file, where its values lie.
struct C3dParameter {
  std::string group, name;  ///< in capitals
  int type = 0;             ///< -1 text, 1 byte, 2 integer, 4 real
  std::vector<std::size_t> dimensions;
  std::size_t at = 0;     ///< byte of the first value
  std::size_t count = 1;  ///< values
};

/// The parameter section of a C3D file.
class C3dParameters {
 public:
  /// Reads the list of parameters, which begins at byte `at`. Adds an error where it runs out of
  /// the file. Keeps a copy of `bytes`, which is a view.
  C3dParameters(const C3dBytes& bytes, std::size_t at, const std::string& file,
                Diagnostics& diagnostics);

  /// nullptr where absent.
  const C3dParameter* find(const std::string& group, const std::string& name) const;
  /// A number of a parameter; nothing where it has no such value.
  std::optional<double> number(const std::string& group, const std::string& name,
                               std::size_t index = 0) const;
  /// The same of a count: whole numbers up to 65535 whose sign bit is used, too.
  std::optional<std::size_t> whole(const std::string& group, const std::string& name,
                                   std::size_t index = 0) const;
  /// The texts of a parameter, without the blanks behind them.
  std::vector<std::string> texts(const std::string& group, const std::string& name) const;

 private:
  struct Group {
    int id = 0;
    std::string name;
  };
  /// What a record says; `next` is 0 behind the last one.
  std::size_t read_record(std::size_t at);
  bool read_parameter(std::size_t at, C3dParameter& parameter);

  C3dBytes bytes_;
  std::vector<C3dParameter> parameters_;
  std::vector<int> group_of_;  ///< identity of the group, by parameter
  std::vector<Group> groups_;
};

}  // namespace pedicel::discrepancy
