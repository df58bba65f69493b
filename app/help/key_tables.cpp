#include "app/help/key_tables.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

#include "app/help/manual_cells.h"
#include "engine/core/check.h"
#include "engine/io/key.h"
#include "engine/world/scene_reader.h"
#include "plugins/discrepancy/files/experiment_lists.h"
#include "plugins/discrepancy/select/verdict_keys.h"
#include "plugins/plant/plant_file_keys.h"

namespace pedicel::app {

namespace {

using io::Key;
using io::KeyType;

struct KeyPage {
  const char* name;
  std::vector<const io::KeyList*> (*lists)();
  KeysOf kind = KeysOf::read_file;
};
constexpr KeyPage key_pages[] = {{"scene_file", world::scene_keys},
                                 {"plant_file", plant::plant_file_keys},
                                 {"experiment", discrepancy::experiment_keys},
                                 {"verdict", discrepancy::verdict_keys, KeysOf::written_file}};

const KeyPage& page_of(const std::string& page) {
  const auto* found =
      std::ranges::find(key_pages, page, [](const KeyPage& one) { return std::string(one.name); });
  PEDICEL_ASSERT(found != std::end(key_pages));
  return *found;
}

const std::string begins_table = "<!-- keys: ", ends_mark = " -->",
                  ends_table = "<!-- end of keys -->";

/// Numbers as people write them: 1e-6 in place of 1e-06, 1e6 in place of 1e+06.
std::string plain(std::string text) {
  for (const auto& [from, to] :
       {std::pair("e-0", "e-"), std::pair("e+0", "e"), std::pair("e+", "e")})
    for (std::size_t at; (at = text.find(from)) != std::string::npos;)
      text.replace(at, std::string_view(from).size(), to);
  return text;
}

/// A time step of 1/240 s is told as such, because no few digits are.
std::string number_text(double x) {
  const std::string text = number_cell(x);
  const double times = std::round(1.0 / x);
  if (std::stod(text) != x && x > 0.0 && 1.0 / times == x) return "1/" + number_cell(times);
  return plain(text);
}

std::string range_text(const io::Bounds& bounds) {
  return plain(range_cell(bounds));
}

std::string type_cell(KeyType type) {
  switch (type) {
    case KeyType::number:
      return "number";
    case KeyType::whole:
      return "whole number";
    case KeyType::flag:
      return "flag";
    case KeyType::text:
      return "text";
    case KeyType::word:
      return "word";
    case KeyType::vector:
      return "vector";
    case KeyType::rotation:
      return "rotation";
    case KeyType::numbers:
      return "numbers";
    case KeyType::list:
      return "list";
    case KeyType::map:
      return "map";
    case KeyType::path:
      return "path";
  }
  return "";
}

std::string vector_text(const Vec3& v) {
  return code("[" + number_text(v.x()) + ", " + number_text(v.y()) + ", " + number_text(v.z()) +
              "]");
}

// What is taken without the key; of a written file, when it is absent.
std::string otherwise_cell(const io::Otherwise& otherwise) {
  if (const auto* told = std::get_if<io::Told>(&otherwise)) return told->text;
  if (const auto* number = std::get_if<double>(&otherwise)) return number_text(*number);
  if (const auto* flag = std::get_if<bool>(&otherwise)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&otherwise)) return code(*text);
  if (const auto* vector = std::get_if<Vec3>(&otherwise)) return vector_text(*vector);
  return "";
}

/// Of what the type alone does not say.
std::string limits_of(const Key& key) {
  const bool bounded = range_text(key.bounds) != range_text(io::any_number);
  switch (key.type) {
    case KeyType::number:
    case KeyType::whole:
      // "any number" says nothing beside words or a form of its own.
      return bounded || (key.words.empty() && key.form.empty()) ? range_text(key.bounds) : "";
    case KeyType::flag:
      return "true, false";
    case KeyType::vector:
      return bounded ? "`[x, y, z]`, each " + range_text(key.bounds) : "`[x, y, z]`";
    case KeyType::rotation:
      return "`[x, y, z, w]`";
    case KeyType::numbers:
      return bounded ? "each " + range_text(key.bounds) : "";
    default:
      return "";
  }
}

std::string bounds_cell(const Key& key, KeysOf kind) {
  const bool is_bounded = range_text(key.bounds) != range_text(io::any_number);
  // What the program writes needs no form to be kept to.
  std::string cell = kind == KeysOf::written_file && !is_bounded ? "" : limits_of(key);
  const auto add = [&](const std::string& part) {
    if (!part.empty()) cell += (cell.empty() ? "" : ", ") + part;
  };
  for (const std::string& word : key.words) add(code(word));
  add(key.form);
  return cell;
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + (cell.empty() ? "|" : " |");
  return text + "\n";
}

/// The lists that a mark names; each may stand on the page once.
std::vector<const io::KeyList*> named(const std::string& mark, const std::string& page,
                                      std::set<std::string>& open) {
  std::vector<const io::KeyList*> found;
  const std::vector<const io::KeyList*> all = keys_of_page(page);
  std::istringstream words(mark);
  for (std::string word; words >> word;) {
    const auto list = std::ranges::find(all, word, [](const auto* one) { return one->name; });
    if (list == all.end())
      throw std::runtime_error(page + ".md: the program has no keys \"" + word + "\"");
    if (open.erase(word) == 0)
      throw std::runtime_error(page + ".md: the keys \"" + word + "\" stand there twice");
    found.push_back(*list);
  }
  return found;
}

}  // namespace

std::vector<std::string> pages_of_keys() {
  std::vector<std::string> names;
  for (const KeyPage& page : key_pages) names.emplace_back(page.name);
  return names;
}

std::vector<const io::KeyList*> keys_of_page(const std::string& page) {
  return page_of(page).lists();
}

std::string key_table(const std::vector<const io::KeyList*>& lists, KeysOf kind) {
  std::string text = kind == KeysOf::written_file
                         ? "| key | type | unit | absent | values | what it is |\n"
                         : "| key | type | unit | default | bounds | what it is |\n";
  text += "|---|---|---|---|---|---|\n";
  const std::string always = kind == KeysOf::written_file ? "" : "needed";
  for (const io::KeyList* list : lists)
    for (const Key& key : list->keys) {
      const bool is_needed = std::holds_alternative<io::Needed>(key.otherwise);
      text +=
          row({code(key.name) + (list->within.empty() ? "" : " (in " + code(list->within) + ")"),
               type_cell(key.type), key.unit, is_needed ? always : otherwise_cell(key.otherwise),
               bounds_cell(key, kind), phrase(key.sentence)});
    }
  return text;
}

std::string with_key_tables(const std::string& page, const std::string& text) {
  std::set<std::string> open;
  for (const io::KeyList* list : keys_of_page(page)) open.insert(list->name);
  std::string out;
  std::size_t done = 0;
  for (std::size_t at; (at = text.find(begins_table, done)) != std::string::npos;) {
    const std::size_t names = at + begins_table.size(), mark = text.find(ends_mark, names),
                      end = text.find(ends_table, at);
    if (mark == std::string::npos || end == std::string::npos)
      throw std::runtime_error(page + ".md: a table of keys has no end, expected " + ends_table);
    out += text.substr(done, mark + ends_mark.size() - done) + "\n\n" +
           key_table(named(text.substr(names, mark - names), page, open), page_of(page).kind) +
           "\n";
    done = end;
  }
  for (const std::string& name : open)
    throw std::runtime_error(page + ".md: the keys \"" + name + "\" are missing, expected " +
                             begins_table + name + ends_mark);
  return out + text.substr(done);
}

}  // namespace pedicel::app
