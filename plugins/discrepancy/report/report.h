#pragma once

#include <filesystem>
#include <string>

#include "plugins/discrepancy/procedure/diagnosis.h"

namespace pedicel::discrepancy {

/// The report as one HTML page: first the card (what is wrong, how sure that is, where, how large,
/// what it gains, what else it could be, what could still hide, what to do next), then all that the
/// diagnosis found out, with its plots. Nothing in it comes from elsewhere.
std::string report_text(const Experiment& experiment, const Diagnosis& diagnosis);

/// The experiment that decides, as a folder beside the report: the trial with its drives and empty
/// tables, `TRIAL/predicted_MODEL.csv` (and `predicted_force_MODEL.csv`) of what each model
/// predicts, and that drawn. Returns the name of its experiment.yaml from `folder`; empty where
/// there is no such trial.
std::string write_next(const std::filesystem::path& folder, const NextExperiment& next);

/// Writes it as report.html into the folder. Throws io::WriteError.
void write_report(const std::filesystem::path& folder, const Experiment& experiment,
                  const Diagnosis& diagnosis);

}  // namespace pedicel::discrepancy
