#include "plugins/skeleton/helios_reader.h"

#include <tinyxml.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "engine/io/number_text.h"
#include "engine/io/xml_text.h"

namespace pedicel::plant {

namespace {

constexpr std::ptrdiff_t most_marks = 4000000;  ///< '<' in a text, so that no file fills the memory
constexpr int most_levels = 50;                 ///< of elements within elements; Helios has 9
constexpr int most_segments = 1000;

std::string_view without_blanks(std::string_view text) {
  constexpr const char* blanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

class HeliosParser {
 public:
  HeliosParser(const std::string& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics), before_(diagnostics.error_count()) {}

  std::optional<HeliosPlant> parse(const std::string& text) {
    if (std::count(text.begin(), text.end(), '<') > most_marks) {
      error({file_}, "more than " + std::to_string(most_marks) + " elements, expected fewer");
      return std::nullopt;
    }
    if (io::is_xml_deeper(text, most_levels)) {
      error({file_}, "elements within elements, more than " + std::to_string(most_levels) +
                         " levels deep, expected Helios' plant structure");
      return std::nullopt;
    }
    TiXmlDocument document;
    document.SetTabSize(1);
    document.Parse(io::xml_in_utf8(text, file_, diagnostics_).c_str(), nullptr,
                   TIXML_ENCODING_UTF8);
    if (document.Error()) {
      error({file_, document.ErrorRow(), document.ErrorCol()},
            std::string(document.ErrorDesc()) + ", expected XML");
      return std::nullopt;
    }
    take_root(document.RootElement());
    if (diagnostics_.error_count() > before_) return std::nullopt;
    return std::move(plant_);
  }

  /// What the file does not say, or what is not read of it.
  void warn() {
    if (bends_)
      diagnostics_.warning(plant_where_,
                           "the file does not hold the shoots' gravitropic curvature, so that they "
                           "are straighter than in Helios; its cylinders (writeQSMCylinderFile) "
                           "hold every place");
    if (organs_) diagnostics_.warning(plant_where_, "leaves, flowers and fruits are not read");
  }

 private:
  SourcePosition where(const TiXmlBase& item) const { return {file_, item.Row(), item.Column()}; }
  void error(const SourcePosition& at, const std::string& what) { diagnostics_.error(at, what); }

  void take_root(const TiXmlElement* root) {
    if (root == nullptr || root->ValueStr() != "helios") {
      error(root != nullptr ? where(*root) : SourcePosition{file_, 1, 1},
            (root != nullptr ? printable("<" + root->ValueStr() + ">", 60) : "nothing") +
                " as the first element, expected <helios> (a plant structure that Helios wrote)");
      return;
    }
    const TiXmlElement* instance = root->FirstChildElement("plant_instance");
    if (instance == nullptr) {
      error(where(*root), "no <plant_instance> in <helios>, expected one");
      return;
    }
    if (const TiXmlElement* second = instance->NextSiblingElement("plant_instance"))
      error(where(*second), "a second <plant_instance>, expected one plant a file");
    take_plant(*instance);
  }

  void take_plant(const TiXmlElement& instance) {
    plant_where_ = plant_.where = where(instance);
    const std::vector<double> base = numbers(instance, "base_position", " \t\r\n", 3);
    for (std::size_t i = 0; i < base.size(); ++i) plant_.base[static_cast<int>(i)] = base[i];
    for (const TiXmlElement* shoot = instance.FirstChildElement("shoot"); shoot != nullptr;
         shoot = shoot->NextSiblingElement("shoot"))
      take_shoot(*shoot);
    if (plant_.shoots.empty())
      error(where(instance), "no <shoot> in <plant_instance>, expected some");
  }

  void take_shoot(const TiXmlElement& element) {
    HeliosShoot shoot;
    shoot.where = where(element);
    const char* id = element.Attribute("ID");
    shoot.id =
        id != nullptr ? whole(id, where(element), "ID") : static_cast<int>(plant_.shoots.size());
    shoot.parent = whole_of(element, "parent_shoot_ID", -1);
    shoot.parent_node = whole_of(element, "parent_node_index", 0);
    shoot.parent_petiole = std::max(0, whole_of(element, "parent_petiole_index", 0));
    const std::vector<double> base = numbers(element, "base_rotation", " \t\r\n", 3);
    if (base.size() == 3) {
      shoot.pitch = base[0];
      shoot.yaw = base[1];
      shoot.roll = base[2];
    }
    for (const TiXmlElement* phytomer = element.FirstChildElement("phytomer"); phytomer != nullptr;
         phytomer = phytomer->NextSiblingElement("phytomer")) {
      const TiXmlElement* internode = phytomer->FirstChildElement("internode");
      if (internode != nullptr)
        shoot.internodes.push_back(take_internode(*internode));
      else
        diagnostics_.repeated_error("internode", where(*phytomer),
                                    "no <internode> in <phytomer>, expected one");
    }
    bends_ |= shoot.internodes.size() > 1 && shoot.internodes.back().vertices.empty();
    plant_.shoots.push_back(std::move(shoot));
  }

  HeliosInternode take_internode(const TiXmlElement& element) {
    HeliosInternode internode;
    internode.where = where(element);
    internode.length = needed(element, "internode_length", 0.0);
    internode.radius = needed(element, "internode_radius", 0.0);
    internode.pitch = number(element, "internode_pitch", 0.0);
    internode.phyllotaxis = number(element, "internode_phyllotactic_angle", 0.0);
    internode.segments = segments(element, "internode_length_segments");
    internode.bend = numbers(element, "curvature_perturbations", ";");
    internode.turn = numbers(element, "yaw_perturbations", ";");
    take_vertices(element, internode);
    for (const TiXmlElement* petiole = element.FirstChildElement("petiole"); petiole != nullptr;
         petiole = petiole->NextSiblingElement("petiole"))
      internode.petioles.push_back(take_petiole(*petiole));
    return internode;
  }

  // "x y z;x y z;..." and "r;r;...", which older versions wrote.
  void take_vertices(const TiXmlElement& element, HeliosInternode& internode) {
    const std::vector<double> values = numbers(element, "internode_vertices", "; \t\r\n");
    if (values.size() % 3 != 0)
      diagnostics_.repeated_error("vertices", where(element),
                                  "<internode_vertices> has " + std::to_string(values.size()) +
                                      " numbers, expected three a vertex");
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
      internode.vertices.emplace_back(values[i], values[i + 1], values[i + 2]);
    internode.radii = numbers(element, "internode_radii", "; \t\r\n");
    if (internode.vertices.empty() || internode.radii.size() != internode.vertices.size())
      internode.radii.clear();
  }

  HeliosPetiole take_petiole(const TiXmlElement& element) {
    HeliosPetiole petiole;
    petiole.where = where(element);
    petiole.length = needed(element, "petiole_length", 0.0);
    petiole.radius = needed(element, "petiole_radius", 0.0);
    petiole.pitch = number(element, "petiole_pitch", 0.0);
    petiole.curvature = number(element, "petiole_curvature", 0.0);
    petiole.taper = std::clamp(number(element, "petiole_taper", 0.0), 0.0, 1.0);
    petiole.scale = number(element, "current_leaf_scale_factor", 1.0);
    petiole.segments = segments(element, "petiole_length_segments");
    organs_ |= element.FirstChildElement("leaf") != nullptr ||
               element.FirstChildElement("floral_bud") != nullptr;
    return petiole;
  }

  static std::string_view text_of(const TiXmlElement& element) {
    const char* text = element.GetText();
    return text != nullptr ? without_blanks(text) : std::string_view{};
  }

  std::optional<double> read(std::string_view text, const SourcePosition& at,
                             const std::string& name) {
    const io::NumberText found = io::number_of(text);
    if (found.kind == io::NumberText::Kind::number) return found.value;
    diagnostics_.repeated_error("number" + name, at,
                                name + " is " + in_quotes(text) + ", expected a number");
    return std::nullopt;
  }

  double number(const TiXmlElement& parent, const char* name, double otherwise) {
    const TiXmlElement* element = parent.FirstChildElement(name);
    if (element == nullptr) return otherwise;
    return read(text_of(*element), where(*element), tag(name)).value_or(otherwise);
  }

  /// A number of at least `least` that has to be there.
  double needed(const TiXmlElement& parent, const char* name, double least) {
    const TiXmlElement* element = parent.FirstChildElement(name);
    if (element == nullptr) {
      diagnostics_.repeated_error(
          name, where(parent), "no " + tag(name) + " in " + tag(parent.Value()) + ", expected it");
      return least;
    }
    const double value = read(text_of(*element), where(*element), tag(name)).value_or(least);
    if (value < least)
      diagnostics_.repeated_error(
          std::string(name) + " least", where(*element),
          tag(name) + " is " + in_quotes(text_of(*element)) + ", expected a number >= 0");
    return std::max(value, least);
  }

  int whole(std::string_view text, const SourcePosition& at, const std::string& name) {
    const double value = read(without_blanks(text), at, name).value_or(0.0);
    if (value == static_cast<double>(static_cast<int>(std::clamp(value, -1.0e9, 1.0e9))))
      return static_cast<int>(value);
    diagnostics_.repeated_error("whole" + name, at,
                                name + " is " + in_quotes(text) + ", expected a whole number");
    return 0;
  }

  int whole_of(const TiXmlElement& parent, const char* name, int otherwise) {
    const TiXmlElement* element = parent.FirstChildElement(name);
    return element != nullptr ? whole(text_of(*element), where(*element), tag(name)) : otherwise;
  }

  int segments(const TiXmlElement& parent, const char* name) {
    const TiXmlElement* element = parent.FirstChildElement(name);
    if (element == nullptr) return 1;
    const int count = whole(text_of(*element), where(*element), tag(name));
    if (count >= 1 && count <= most_segments) return count;
    diagnostics_.repeated_error(std::string("segments") + name, where(*element),
                                tag(name) + " is " + std::to_string(count) +
                                    ", expected a number from 1 to " +
                                    std::to_string(most_segments));
    return 1;
  }

  /// Numbers parted by any of `marks`; `count` of them where that is not 0. An element that is not
  /// there has none.
  std::vector<double> numbers(const TiXmlElement& parent, const char* name, const char* marks,
                              std::size_t count = 0) {
    const TiXmlElement* element = parent.FirstChildElement(name);
    if (element == nullptr) return {};
    std::vector<double> values;
    std::string_view text = text_of(*element);
    while (!text.empty()) {
      const std::string_view word = without_blanks(text.substr(0, text.find_first_of(marks)));
      text.remove_prefix(std::min(text.find_first_of(marks), text.size() - 1) + 1);
      if (word.empty()) continue;
      const std::optional<double> value = read(word, where(*element), tag(name));
      if (!value) return {};
      values.push_back(*value);
    }
    if (count == 0 || values.size() == count) return values;
    diagnostics_.repeated_error(std::string("count") + name, where(*element),
                                tag(name) + " has " + std::to_string(values.size()) +
                                    " numbers, expected " + std::to_string(count));
    return {};
  }

  static std::string tag(const char* name) { return "<" + printable(name, 60) + ">"; }

  const std::string& file_;
  Diagnostics& diagnostics_;
  int before_;
  HeliosPlant plant_;
  SourcePosition plant_where_;
  bool bends_ = false, organs_ = false;
};

}  // namespace

std::vector<SkeletonNode> parse_helios_xml(const std::string& text, const std::string& file,
                                           Diagnostics& diagnostics, double unit) {
  HeliosParser parser(file, diagnostics);
  const std::optional<HeliosPlant> plant = parser.parse(text);
  if (!plant) return {};
  std::vector<SkeletonNode> nodes = helios_nodes(*plant, unit > 0.0 ? unit : 1.0, diagnostics);
  if (!nodes.empty()) parser.warn();
  return nodes;
}

bool is_helios_xml(const std::string& text) {
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at + 1)) {
    const char next = at + 1 < text.size() ? text[at + 1] : '\0';
    if (next == '?' || next == '!') continue;
    return std::string_view(text).substr(at).starts_with("<helios");
  }
  return false;
}

}  // namespace pedicel::plant
