#pragma once

#include <tinyxml.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "engine/urdf/urdf_remarks.h"

namespace pedicel::robot {

/// Reads values out of a URDF's XML and reports what is wrong with them where they stand. A read
/// that failed has been reported and returns nothing.
class UrdfXml {
 public:
  UrdfXml(std::string file, Diagnostics& diagnostics)
      : file_(std::move(file)), diagnostics_(&diagnostics) {}

  const std::string& file() const { return file_; }
  SourcePosition position(const TiXmlBase& where) const {
    return {file_, where.Row(), where.Column()};
  }
  void error(const TiXmlBase& where, std::string what) const;
  void warning(const TiXmlBase& where, std::string what) const;

  /// A required attribute's text; `what` names the element ("link", "joint 'elbow'").
  std::optional<std::string> text(const TiXmlElement& element, const char* attribute,
                                  const std::string& what) const;
  /// A finite number; an absent attribute is an error only where `required`.
  std::optional<double> number(const TiXmlElement& element, const char* attribute,
                               const std::string& what, bool required = true) const;
  /// The same, which must also be at least 0, or above 0 where `open`.
  std::optional<double> not_negative(const TiXmlElement& element, const char* attribute,
                                     const std::string& what, bool required, bool open) const;
  /// Exactly `count` finite numbers separated by blanks; an absent attribute is no error.
  std::optional<std::vector<double>> numbers(const TiXmlElement& element, const char* attribute,
                                             std::size_t count, const std::string& what) const;
  /// Checks an element's <origin>, where it has one.
  void check_origin(const TiXmlElement& parent, const std::string& what) const;

 private:
  std::optional<double> parse(const TiXmlElement& element, const char* attribute,
                              const std::string& word, const std::string& what) const;

  std::string file_;
  Diagnostics* diagnostics_;
};

/// The position of an attribute, or of its element where the attribute is absent.
const TiXmlBase& attribute_or_element(const TiXmlElement& element, const char* attribute);

/// Whether an attribute is there and says "inf", with or without a sign: no limit.
bool is_endless(const TiXmlElement& element, const char* attribute);

/// All child elements of one name, in the order of the file.
std::vector<const TiXmlElement*> children(const TiXmlElement& parent, const char* name);

/// Reports the first trace of an unexpanded xacro, with the command that expands it. True where
/// there is one: numbers cannot be checked then. A call that is left in a file which xacro wrote
/// itself is remarked and passed over, as everything else passes over it.
bool check_xacro(const UrdfXml& xml, const TiXmlElement& robot, UrdfRemarks& remarks);

/// Names, inertials, visuals and collisions; not the files of meshes.
void check_links(const UrdfXml& xml, const TiXmlElement& robot);

/// Names, types, and of joints that move axes, limits, dynamics, mimics.
void check_joints(const UrdfXml& xml, const TiXmlElement& robot, UrdfRemarks& remarks);

/// One root, one parent per link, no cycle.
void check_tree(const UrdfXml& xml, const TiXmlElement& robot);

}  // namespace pedicel::robot
