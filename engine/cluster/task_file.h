#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::cluster {

/// What a program must be for its results to be taken together with those of another run of it.
struct ProgramIdentity {
  std::string version, git_hash;  ///< "0.2.0", "eb1c323"
  std::string build;              ///< build_id()
  bool operator==(const ProgramIdentity&) const = default;
};

/// A file that cases read.
struct Input {
  std::string path;    ///< from the task file's folder, or absolute
  std::string sha256;  ///< of its contents, when the task file was written
};

/// One thing to do: a command whose results are whole or not there.
struct Case {
  int number = 0;  ///< from 0 on, in the order of the file
  int block = 0;   ///< done one after the other by one task; blocks are in order, too
  std::string id;  ///< 32 hexadecimal digits: case_id()
  std::string name;
  std::vector<std::string> arguments;  ///< after those that all share; "{out}" is its folder
};

/// The head of a task file.
struct TaskHead {
  std::string verb;            ///< "sweep"
  std::filesystem::path file;  ///< of the program
  ProgramIdentity program;
  std::string instruction_set;      ///< asked for; empty: each processor's best
  std::filesystem::path folder;     ///< where the commands run
  std::vector<std::string> common;  ///< first arguments of every case
  std::vector<std::string> again;   ///< arguments of the call that wrote this file
  std::vector<int> results;         ///< exit codes that are results, and no failures
  std::vector<Input> inputs;        ///< of every case
  double case_seconds = 0.0;        ///< s, expected of one; 0: unknown
  double block_seconds = 0.0;       ///< s, that a block is to take
  int threads = 1;                  ///< of one case
  int cases = 0, blocks = 0;
  std::string run;  ///< 8 hexadecimal digits of all cases and blocks
};

struct TaskFile {
  TaskHead head;
  std::vector<Case> cases;
};

/// What stands for a case's own folder among its arguments.
inline constexpr std::string_view out_mark = "{out}";

/// At most this many cases and blocks in one file.
inline constexpr int most_cases = 10'000'000;

/// The name of a case's results: of program, instruction set, arguments, names and contents of its
/// inputs, and of nothing else.
std::string case_id(const TaskHead& head, const Case& one);
/// Of `run`, from everything else.
std::string run_id(const TaskFile& tasks);

/// Lines of JSON: the head, then one a case. Written aside and renamed, with the index beside it.
/// Throws io::WriteError.
void write_task_file(const std::filesystem::path& path, const TaskFile& tasks);

/// Throws InvalidFile with every fault.
TaskFile read_task_file(const std::filesystem::path& path);
TaskHead read_task_head(const std::filesystem::path& path);
/// The head, and the cases of one block, which are found by the index.
TaskFile read_block(const std::filesystem::path& path, int block);

/// Of a text in memory.
TaskFile parse_task_file(std::string_view text, const std::string& name, Diagnostics& diagnostics);

}  // namespace pedicel::cluster
