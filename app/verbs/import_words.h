#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/verbs/import.h"
#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/experiment_import.h"

/// Options of `pedicel import`, and what their words mean. What cannot be meant is a UsageError
/// that names the option.
namespace pedicel::app {

void add_frame_options(CLI::App& verb, ImportArguments& a);
void add_place_options(CLI::App& verb, ImportArguments& a);
void add_force_options(CLI::App& verb, ImportArguments& a);

/// "mm" or "0.001" in metres.
double length_of_text(const std::string& text, const std::string& option);
/// A unit's size in SI units.
double factor_of_text(const std::string& text, io::Quantity quantity, const std::string& option);

/// Throws UsageError with what to add to the command line, each sentence once; nothing where there
/// is none.
void refuse_missing(const std::vector<std::string>& missing);

/// The parts before and behind the last `mark`, both there.
std::pair<std::string, std::string> split_words(const std::string& text, char mark,
                                                const std::string& option,
                                                const std::string& expected);
/// "stem:0.5".
plant::CurvePlace curve_place(const std::string& text, const std::string& option);
/// "m1=stem:0.5".
std::pair<std::string, plant::CurvePlace> placed_point(const std::string& text,
                                                       const std::string& option);
/// A name that a table can have as a column, once.
void check_marker_name(const std::string& name, const std::vector<discrepancy::PlacedPoint>& places,
                       std::size_t index);

/// Values of the trials: "VALUE" for all of them, or "TRIAL=VALUE".
class TrialWords {
 public:
  TrialWords(const std::vector<std::string>& texts, const std::vector<std::string>& trials,
             const std::string& option);

  bool is_for_all() const { return for_all_.has_value(); }
  std::optional<std::string> of(const std::string& trial) const;
  std::optional<double> number(const std::string& trial) const;

 private:
  std::string option_;
  std::optional<std::string> for_all_;
  std::vector<std::pair<std::string, std::string>> by_trial_;
};

}  // namespace pedicel::app
