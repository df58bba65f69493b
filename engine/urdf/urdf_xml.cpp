#include "engine/urdf/urdf_xml.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

#include "engine/io/thing_bounds.h"

namespace pedicel::robot {

namespace {

/// How many numbers are there once every comma is a blank; 0 without a comma.
std::size_t parted_by_commas(std::string text) {
  if (text.find(',') == std::string::npos) return 0;
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream(text);
  std::size_t count = 0;
  for (std::string word; stream >> word;) ++count;
  return count;
}

}  // namespace

void UrdfXml::error(const TiXmlBase& where, std::string what) const {
  diagnostics_->error(position(where), std::move(what));
}

void UrdfXml::warning(const TiXmlBase& where, std::string what) const {
  diagnostics_->warning(position(where), std::move(what));
}

std::optional<std::string> UrdfXml::text(const TiXmlElement& element, const char* attribute,
                                         const std::string& what) const {
  const char* value = element.Attribute(attribute);
  if (value != nullptr && *value != '\0') return value;
  error(attribute_or_element(element, attribute),
        what + ": no " + attribute + ", expected " + attribute + "=\"...\"");
  return {};
}

std::optional<double> UrdfXml::parse(const TiXmlElement& element, const char* attribute,
                                     const std::string& word, const std::string& what) const {
  double value = 0.0;
  const char* begin = word.c_str();
  if (*begin == '+') ++begin;
  const char* end = word.c_str() + word.size();
  const auto [stop, fault] = std::from_chars(begin, end, value);
  if (fault == std::errc{} && stop == end && std::isfinite(value)) return value;
  const bool comma = word.find(',') != std::string::npos;
  error(attribute_or_element(element, attribute),
        what + ": " + attribute + " \"" + word + "\" is not a finite number" +
            (comma ? ", expected a point, not a comma" : ", expected a number such as 0.05"));
  return {};
}

std::optional<double> UrdfXml::number(const TiXmlElement& element, const char* attribute,
                                      const std::string& what, bool required) const {
  if (!required && element.Attribute(attribute) == nullptr) return {};
  const std::optional<std::string> word = text(element, attribute, what);
  if (!word) return {};
  return parse(element, attribute, *word, what);
}

std::optional<double> UrdfXml::not_negative(const TiXmlElement& element, const char* attribute,
                                            const std::string& what, bool required,
                                            bool open) const {
  const std::optional<double> value = number(element, attribute, what, required);
  if (!value || *value > 0.0 || (*value == 0.0 && !open)) return value;
  error(attribute_or_element(element, attribute),
        what + ": " + attribute + " \"" + element.Attribute(attribute) + "\", expected " +
            (open ? "more than 0" : "0 or more"));
  return {};
}

std::optional<std::vector<double>> UrdfXml::numbers(const TiXmlElement& element,
                                                    const char* attribute, std::size_t count,
                                                    const std::string& what) const {
  const char* value = element.Attribute(attribute);
  if (value == nullptr) return {};
  if (parted_by_commas(value) == count) {
    error(attribute_or_element(element, attribute),
          what + ": " + attribute + " \"" + value + "\" has commas, expected " +
              std::to_string(count) + " numbers separated by blanks");
    return {};
  }
  std::istringstream stream(value);
  std::vector<double> result;
  std::size_t words = 0;
  for (std::string word; stream >> word; ++words) {
    const std::optional<double> number = parse(element, attribute, word, what);
    if (!number) return {};
    result.push_back(*number);
  }
  if (words == count) return result;
  error(attribute_or_element(element, attribute),
        what + ": " + attribute + " \"" + value + "\" has " + std::to_string(words) +
            " numbers, expected " + std::to_string(count) + " separated by blanks");
  return {};
}

void UrdfXml::check_origin(const TiXmlElement& parent, const std::string& what) const {
  const TiXmlElement* origin = parent.FirstChildElement("origin");
  if (origin == nullptr) return;
  if (const auto xyz = numbers(*origin, "xyz", 3, what + ": origin"))
    for (const double one : *xyz)
      if (!io::within(one, io::place_bounds)) {
        error(attribute_or_element(*origin, "xyz"),
              what + ": origin: xyz \"" + origin->Attribute("xyz") + "\", expected m, each " +
                  io::bounds_text(io::place_bounds));
        break;
      }
  numbers(*origin, "rpy", 3, what + ": origin");
  const auto q = numbers(*origin, "quat_xyzw", 4, what + ": origin");
  if (q && Eigen::Map<const Eigen::Vector4d>(q->data()).norm() < 1e-6)
    error(attribute_or_element(*origin, "quat_xyzw"),
          what + ": origin: quat_xyzw of length 0, expected a rotation such as 0 0 0 1");
  if (q && origin->Attribute("rpy") != nullptr)
    error(attribute_or_element(*origin, "quat_xyzw"),
          what + ": origin: quat_xyzw beside rpy, expected one of them");
}

const TiXmlBase& attribute_or_element(const TiXmlElement& element, const char* attribute) {
  for (const TiXmlAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next())
    if (std::string(a->Name()) == attribute) return *a;
  return element;
}

bool is_endless(const TiXmlElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  if (text == nullptr) return false;
  std::string word(text + (*text == '-' || *text == '+' ? 1 : 0));
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word == "inf" || word == "infinity";
}

std::vector<const TiXmlElement*> children(const TiXmlElement& parent, const char* name) {
  std::vector<const TiXmlElement*> found;
  for (const TiXmlElement* child = parent.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name))
    found.push_back(child);
  return found;
}

}  // namespace pedicel::robot
