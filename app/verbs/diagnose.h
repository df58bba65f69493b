#pragma once

#include <filesystem>
#include <functional>

#include "plugins/discrepancy/procedure/diagnosis.h"

namespace CLI {
class App;
}

namespace pedicel::app {

/// `pedicel diagnose EXPERIMENT --out DIR`: what the simulation of an experiment gets wrong. Adds
/// the verb to the command line; the result runs it and returns the program's exit code.
std::function<int()> add_diagnose_verb(CLI::App& app);

/// report.html, verdict.json, and where there are such extended.plant.yaml and next/. Sets the
/// names of these in the verdict. Throws io::WriteError.
void write_diagnosis(const std::filesystem::path& folder, const discrepancy::Experiment& experiment,
                     discrepancy::Diagnosis& diagnosis);

}  // namespace pedicel::app
