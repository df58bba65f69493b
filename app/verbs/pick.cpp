#include "app/verbs/pick.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/verbs/import_words.h"
#include "engine/core/check.h"
#include "engine/core/exit_code.h"
#include "engine/io/output_kind.h"
#include "engine/io/unit_text.h"
#include "plugins/discrepancy/pick/pick_labels.h"
#include "plugins/discrepancy/pick/pick_report.h"
#include "plugins/discrepancy/pick/pick_text.h"

namespace pedicel::app {

namespace {

struct PickArguments {
  std::vector<std::string> files, force_columns;
  std::string time_column, time_unit, force_unit, labels, report;
  discrepancy::PickSettings settings;
  bool json = false;
};

discrepancy::PickColumns columns_of(const PickArguments& a) {
  if (a.force_columns.size() > 3)
    throw UsageError("--force-column: " + std::to_string(a.force_columns.size()) +
                     " are given, expected one to three, one an axis");
  discrepancy::PickColumns columns;
  columns.force = a.force_columns;
  if (!a.time_column.empty()) columns.time = a.time_column;
  if (!a.time_unit.empty())
    columns.time_unit = factor_of_text(a.time_unit, io::Quantity::time, "--time-unit");
  if (!a.force_unit.empty())
    columns.force_unit = factor_of_text(a.force_unit, io::Quantity::force, "--force-unit");
  return columns;
}

/// What is wrong with the files that could not be read; the others are judged all the same.
struct Faults {
  Diagnostics diagnostics;
  discrepancy::ImportNotes notes;
};

std::vector<discrepancy::JudgedPick> judge_files(const PickArguments& a, Faults& faults) {
  const discrepancy::PickColumns columns = columns_of(a);
  std::vector<discrepancy::JudgedPick> all;
  for (const std::string& file : a.files) {
    const int errors = faults.diagnostics.error_count();
    const std::size_t missing = faults.notes.missing.size();
    discrepancy::JudgedPick judged;
    try {
      judged.record =
          discrepancy::read_pick_record(file, columns, faults.diagnostics, faults.notes);
    } catch (const InvalidFile& fault) {
      faults.diagnostics.add(fault);
    }
    if (faults.diagnostics.error_count() > errors || faults.notes.missing.size() > missing)
      continue;
    judged.pick = discrepancy::judge_pick(judged.record, a.settings);
    all.push_back(std::move(judged));
  }
  return all;
}

void print(const PickArguments& a, const std::vector<discrepancy::JudgedPick>& all) {
  if (a.json)
    std::cout << to_json(all) << std::endl;
  else if (a.files.size() == 1)
    for (const discrepancy::JudgedPick& judged : all) std::cout << to_text(judged);
  else
    std::cout << to_table(all);
}

void compare(const PickArguments& a, const std::vector<discrepancy::JudgedPick>& all,
             Faults& faults) {
  const auto labels = discrepancy::read_pick_labels(a.labels, faults.diagnostics);
  if (faults.diagnostics.has_errors()) return;
  const std::string text = compare_with_labels(all, labels).to_text();
  std::fputs(text.c_str(), a.json ? stderr : stdout);
}

int run(const PickArguments& a) {
  if (const std::string fault = check(a.settings); !fault.empty()) throw UsageError("--" + fault);
  if (!a.report.empty()) io::check_output_file(a.report, io::OutputKind::page);
  Faults faults;
  const std::vector<discrepancy::JudgedPick> all = judge_files(a, faults);
  for (const std::string& sentence : faults.notes.said)
    std::fprintf(stderr, "%s\n", sentence.c_str());
  if (!all.empty() || a.files.size() > 1) print(a, all);
  std::cout << std::flush;
  if (!a.labels.empty()) compare(a, all, faults);
  if (!a.report.empty() && !all.empty()) write_pick_report(a.report, all, a.settings);
  if (faults.diagnostics.has_errors()) throw InvalidFile(faults.diagnostics);
  refuse_missing(faults.notes.missing);
  return exit_ok;
}

void add_column_options(CLI::App& verb, PickArguments& a) {
  verb.add_option("--time-column", a.time_column, "name of the time's column (default: time)");
  verb.add_option(
          "--force-column", a.force_columns,
          "name of a force's column, once an axis (default: fx, fy and fz, force_x, ..., or "
          "the only force)")
      ->allow_extra_args(false);
  verb.add_option("--time-unit", a.time_unit, "s, ms, ...: where the table does not say it");
  verb.add_option("--force-unit", a.force_unit, "N, mN, gf, ...: where the table does not say it");
}

void add_setting_options(CLI::App& verb, discrepancy::PickSettings& s) {
  verb.add_option("--rest", s.rest, "at the start, whose median is the force's zero, s")
      ->capture_default_str();
  verb.add_option("--response", s.response,
                  "half of the load lost within it is a break: a quarter of a period of the arm's "
                  "own swing, s")
      ->capture_default_str();
  verb.add_option("--sharpness", s.sharpness,
                  "the odds of a break are (response / time to half) to this power")
      ->capture_default_str();
  verb.add_option("--share", s.share, "of the load that is gone where it was let go")
      ->capture_default_str();
}

}  // namespace

std::function<int()> add_pick_verb(CLI::App& app) {
  const auto a = std::make_shared<PickArguments>();
  CLI::App* verb = app.add_subcommand(
      "pick", "whether and when a fruit came off, from the force at a robot's wrist");
  verb->add_option("files", a->files, "tables of time and force, one a pick")->required();
  add_column_options(*verb, *a);
  add_setting_options(*verb, a->settings);
  verb->add_option("--labels", a->labels,
                   "table of picks with their outcomes, to compare with and to calibrate by");
  verb->add_option("--report", a->report, "HTML page to write, with a plot of each record");
  verb->add_flag("--json", a->json, "as JSON: an object for one file, an array for several");
  return [a] { return run(*a); };
}

}  // namespace pedicel::app
