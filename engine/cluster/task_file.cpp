#include "engine/cluster/task_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/cluster/sha256.h"
#include "engine/io/atomic_file.h"

namespace pedicel::cluster {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int format_version = 1;
constexpr std::size_t longest_line = std::size_t{16} << 20;  // bytes
constexpr int id_digits = 32, run_digits = 8;
constexpr double longest_block = 1.0e7;  // s
constexpr int most_threads = 1024;

/// Every text with its length before it, so that no two lists run together to the same.
class Sum {
 public:
  void add(std::string_view text) {
    all_ += std::to_string(text.size());
    all_ += ':';
    all_ += text;
  }
  void add(const std::vector<std::string>& texts) {
    add(std::to_string(texts.size()));
    for (const std::string& text : texts) add(text);
  }
  std::string digits(int count) const { return sha256(all_).substr(0, count); }

 private:
  std::string all_;
};

Json head_json(const TaskHead& head) {
  Json json = {{"format", "pedicel-tasks"},
               {"version", format_version},
               {"verb", head.verb},
               {"program",
                {{"file", head.file.string()},
                 {"version", head.program.version},
                 {"git_hash", head.program.git_hash},
                 {"build", head.program.build}}},
               {"instruction_set", head.instruction_set},
               {"folder", head.folder.string()},
               {"again", head.again},
               {"common", head.common},
               {"results", head.results}};
  json["inputs"] = Json::array();
  for (const Input& input : head.inputs)
    json["inputs"].push_back({{"path", input.path}, {"sha256", input.sha256}});
  json["threads"] = head.threads;
  json["case_seconds"] = head.case_seconds;
  json["block_seconds"] = head.block_seconds;
  json["cases"] = head.cases;
  json["blocks"] = head.blocks;
  json["run"] = head.run;
  return json;
}

Json case_json(const Case& one) {
  return {{"case", one.number},
          {"block", one.block},
          {"id", one.id},
          {"name", one.name},
          {"arguments", one.arguments}};
}

/// One line of the file: its values, and what is wrong with them.
class Line {
 public:
  Line(std::string_view text, const std::string& file, int number, Diagnostics& diagnostics)
      : where_{file, number, number > 0 ? 1 : 0},
        diagnostics_(diagnostics),
        json_(Json::parse(text.begin(), text.end(), nullptr, false)) {
    if (!json_.is_object()) fault("is no JSON object, expected one a line");
  }
  bool good() const { return good_; }

  std::string text(const char* key) { return text_of(json_, key); }
  std::string text(const char* section, const char* key) {
    return text_of(at(json_, section), key);
  }

  std::vector<std::string> texts(const char* key) {
    std::vector<std::string> all;
    const Json& list = at(json_, key);
    if (!list.is_array()) return fault(key, "expected a list of texts"), all;
    for (const Json& one : list) {
      if (!one.is_string()) return fault(key, "expected a list of texts"), all;
      all.push_back(one.get<std::string>());
    }
    return all;
  }

  int whole(const char* key, int least, int most) {
    return whole_of(at(json_, key), key, least, most);
  }

  std::vector<int> codes(const char* key) {
    std::vector<int> all;
    const Json& list = at(json_, key);
    if (!list.is_array()) return fault(key, "expected a list of exit codes"), all;
    for (const Json& one : list) all.push_back(whole_of(one, key, 0, 255));
    return all;
  }

  double number(const char* key, double most) {
    const Json& value = at(json_, key);
    const double number = value.is_number() ? value.get<double>() : -1.0;
    if (number >= 0.0 && number <= most) return number;
    fault(key, "expected a number from 0 to " + std::to_string(static_cast<long>(most)));
    return 0.0;
  }

  std::vector<Input> inputs(const char* key) {
    std::vector<Input> all;
    const Json& list = at(json_, key);
    if (!list.is_array()) return fault(key, "expected a list of files"), all;
    for (const Json& one : list) all.push_back({text_of(one, "path"), text_of(one, "sha256")});
    return all;
  }

  void fault(const std::string& what) {
    if (good_) diagnostics_.error(where_, what);
    good_ = false;
  }
  void fault(const char* key, const std::string& what) { fault(std::string(key) + ": " + what); }

 private:
  static const Json& at(const Json& json, const char* key) {
    static const Json none;
    const auto found = json.is_object() ? json.find(key) : json.end();
    return json.is_object() && found != json.end() ? *found : none;
  }
  std::string text_of(const Json& json, const char* key) {
    const Json& value = at(json, key);
    if (value.is_string()) return value.get<std::string>();
    fault(key, "expected a text");
    return {};
  }
  int whole_of(const Json& value, const char* key, int least, int most) {
    if (value.is_number_integer()) {
      const auto number = value.get<std::int64_t>();
      if (number >= least && number <= most) return static_cast<int>(number);
    }
    fault(key,
          "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return least;
  }

  SourcePosition where_;
  Diagnostics& diagnostics_;
  Json json_;
  bool good_ = true;
};

bool are_hexadecimal(const std::string& text, int count) {
  return static_cast<int>(text.size()) == count &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

TaskHead parse_head(Line& line) {
  TaskHead head;
  if (line.text("format") != "pedicel-tasks") line.fault("format", "expected pedicel-tasks");
  line.whole("version", format_version, format_version);
  head.verb = line.text("verb");
  head.file = line.text("program", "file");
  head.program = {line.text("program", "version"), line.text("program", "git_hash"),
                  line.text("program", "build")};
  head.instruction_set = line.text("instruction_set");
  head.folder = line.text("folder");
  head.again = line.texts("again");
  head.common = line.texts("common");
  head.results = line.codes("results");
  head.inputs = line.inputs("inputs");
  head.threads = line.whole("threads", 1, most_threads);
  head.case_seconds = line.number("case_seconds", longest_block);
  head.block_seconds = line.number("block_seconds", longest_block);
  head.cases = line.whole("cases", 0, most_cases);
  head.blocks = line.whole("blocks", 0, most_cases);
  head.run = line.text("run");
  if (!are_hexadecimal(head.run, run_digits)) line.fault("run", "expected 8 hexadecimal digits");
  for (const Input& input : head.inputs)
    if (!are_hexadecimal(input.sha256, 64))
      line.fault("inputs", "expected 64 hexadecimal digits of sha256");
  return head;
}

Case parse_case(Line& line, const TaskHead& head) {
  Case one;
  one.number = line.whole("case", 0, std::max(0, head.cases - 1));
  one.block = line.whole("block", 0, std::max(0, head.blocks - 1));
  one.id = line.text("id");
  one.name = line.text("name");
  one.arguments = line.texts("arguments");
  if (!are_hexadecimal(one.id, id_digits)) line.fault("id", "expected 32 hexadecimal digits");
  return one;
}

void check_order(const Case& one, const TaskFile& tasks, Line& line) {
  const int expected = static_cast<int>(tasks.cases.size());
  if (one.number != expected)
    line.fault("case", "is " + std::to_string(one.number) + ", expected " +
                           std::to_string(expected) + ", as the cases come");
  const int before = tasks.cases.empty() ? 0 : tasks.cases.back().block;
  if (one.block < before || one.block > before + 1)
    line.fault("block", "is " + std::to_string(one.block) + " after " + std::to_string(before) +
                            ", expected the same or the next one");
}

/// Line after line, as they come.
class Reader {
 public:
  Reader(const std::string& name, Diagnostics& diagnostics)
      : name_(name), diagnostics_(diagnostics) {}

  void add(std::string_view text) {
    Line line(text, name_, ++number_, diagnostics_);
    if (!line.good()) return;
    if (number_ == 1) {
      tasks_.head = parse_head(line);
      return;
    }
    Case one = parse_case(line, tasks_.head);
    check_order(one, tasks_, line);
    tasks_.cases.push_back(std::move(one));
  }

  TaskFile finish() {
    const int cases = static_cast<int>(tasks_.cases.size());
    if (!diagnostics_.has_errors() && (number_ == 0 || cases != tasks_.head.cases))
      diagnostics_.error({name_}, "has " + std::to_string(cases) + " cases, expected the " +
                                      std::to_string(tasks_.head.cases) + " of its first line");
    return std::move(tasks_);
  }

 private:
  const std::string& name_;
  Diagnostics& diagnostics_;
  TaskFile tasks_;
  int number_ = 0;
};

/// The file's lines, one after the other.
class Lines {
 public:
  explicit Lines(const fs::path& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_)
      throw InvalidFile({path.string()}, std::string("cannot be read: ") + std::strerror(errno));
  }
  void go_to(std::uint64_t offset) { file_.seekg(static_cast<std::streamoff>(offset)); }
  bool next(std::string& line) {
    if (!std::getline(file_, line)) return false;
    if (line.size() > longest_line)
      throw InvalidFile({path_.string()}, "has a line of more than 16 MB, expected shorter ones");
    return true;
  }

 private:
  const fs::path& path_;
  std::ifstream file_;
};

TaskHead head_of(Lines& lines, const fs::path& path) {
  std::string text;
  lines.next(text);
  Diagnostics diagnostics;
  Line line(text, path.string(), 1, diagnostics);
  TaskHead head;
  if (line.good()) head = parse_head(line);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return head;
}

// Of every block the place of its first line, as 20 digits and a line end: found without reading
// the others.
constexpr int index_width = 21;

fs::path index_of(const fs::path& path) {
  return path.string() + ".index";
}

std::string index_line(std::size_t offset) {
  char line[index_width + 1];
  std::snprintf(line, sizeof line, "%020zu\n", offset);
  return line;
}

std::uint64_t offset_of(const fs::path& path, int block) {
  std::ifstream file(index_of(path), std::ios::binary);
  file.seekg(static_cast<std::streamoff>(block) * index_width);
  std::string line;
  std::uint64_t offset = 0;
  if (!std::getline(file, line) ||
      std::from_chars(line.data(), line.data() + line.size(), offset).ptr !=
          line.data() + line.size())
    throw InvalidFile({index_of(path).string()}, "does not have block " + std::to_string(block));
  return offset;
}

}  // namespace

std::string case_id(const TaskHead& head, const Case& one) {
  Sum sum;
  sum.add("pedicel-case 1");
  sum.add({head.program.version, head.program.git_hash, head.program.build});
  sum.add(head.instruction_set);
  sum.add(head.common);
  sum.add(one.arguments);
  for (const Input& input : head.inputs) sum.add({input.path, input.sha256});
  return sum.digits(id_digits);
}

std::string run_id(const TaskFile& tasks) {
  Sum sum;
  for (const Case& one : tasks.cases) sum.add({one.id, one.name, std::to_string(one.block)});
  return sum.digits(run_digits);
}

void write_task_file(const fs::path& path, const TaskFile& tasks) {
  std::string text = head_json(tasks.head).dump() + "\n", index;
  int block = -1;
  for (const Case& one : tasks.cases) {
    if (one.block != block) index += index_line(text.size());
    block = one.block;
    text += case_json(one).dump() + "\n";
  }
  io::write_file_atomically(index_of(path), index);
  io::write_file_atomically(path, text);
}

TaskFile parse_task_file(std::string_view text, const std::string& name, Diagnostics& diagnostics) {
  Reader reader(name, diagnostics);
  for (std::size_t start = 0; start < text.size() && !diagnostics.has_errors();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    reader.add(text.substr(start, end - start));
    start = end + 1;
  }
  return reader.finish();
}

TaskFile read_task_file(const fs::path& path) {
  Diagnostics diagnostics;
  Lines lines(path);
  const std::string name = path.string();
  Reader reader(name, diagnostics);
  for (std::string text; !diagnostics.has_errors() && lines.next(text);) reader.add(text);
  TaskFile tasks = reader.finish();
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return tasks;
}

TaskHead read_task_head(const fs::path& path) {
  Lines lines(path);
  return head_of(lines, path);
}

TaskFile read_block(const fs::path& path, int block) {
  TaskFile tasks;
  Lines lines(path);
  tasks.head = head_of(lines, path);
  if (block < 0 || block >= tasks.head.blocks)
    throw InvalidFile({path.string()}, "has " + std::to_string(tasks.head.blocks) +
                                           " blocks, expected a block from 0 on below that");
  lines.go_to(offset_of(path, block));
  Diagnostics diagnostics;
  for (std::string text; lines.next(text);) {
    Line line(text, path.string(), 0, diagnostics);
    Case one;
    if (line.good()) one = parse_case(line, tasks.head);
    if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
    if (one.block != block) break;
    tasks.cases.push_back(std::move(one));
  }
  return tasks;
}

}  // namespace pedicel::cluster
