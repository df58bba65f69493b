#include <chrono>
#include <thread>

#include "pedicel/app/session/commands/measured_commands.h"
#include "pedicel/app/session/journal.h"
#include "pedicel/app/session/measured/diagnosis_card.h"
#include "pedicel/app/session/measured/experiment_reading.h"
#include "pedicel/app/session/measured/measured_data.h"
#include "pedicel/app/session/session.h"
#include "pedicel/core/check.h"
#include "pedicel/discrepancy/report/report.h"
#include "pedicel/io/atomic_file.h"

/// A session and the data that were measured on its plant.
namespace pedicel::app {

namespace {

/// The experiment's plant alone, to be looked at and changed; the experiment keeps its own.
Document document_of(const discrepancy::Experiment& experiment) {
  Document document = empty_document();
  DocumentPlant one;
  one.entry.name = experiment.plant.name;
  one.file = std::make_shared<const plant::PlantFile>(experiment.plant);
  document.plants.push_back(std::move(one));
  stand_on_ground(document);
  return document;
}

/// The plant that is drawn like another one; -1: none.
int find_plant(const Document& document, const plant::PlantFile& like) {
  for (std::size_t i = 0; i < document.plants.size(); ++i) {
    const auto& file = document.plants[i].file;
    if (file && file->curves == like.curves && file->root == like.root) return static_cast<int>(i);
  }
  return -1;
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

void write_diagnosis_files(const std::filesystem::path& folder,
                           const discrepancy::Experiment& experiment,
                           const std::optional<plant::PlantFile>& extended,
                           discrepancy::Diagnosis diagnosis) {
  if (extended) {
    diagnosis.verdict.extended_plant = "extended.plant.yaml";
    plant::write_plant_file(folder / diagnosis.verdict.extended_plant, *extended);
  }
  io::write_file_atomically(folder / "verdict.json", to_json(diagnosis.verdict) + "\n");
  discrepancy::write_report(folder, experiment, diagnosis);
}

}  // namespace

int Session::measured_plant() const {
  const discrepancy::Experiment* experiment = measured_->experiment();
  return experiment ? find_plant(document_, experiment->plant) : -1;
}

Result Session::open_experiment(const std::filesystem::path& path) {
  if (measured_->is_diagnosing()) {
    reading_fault_ = path.string() + ": a diagnosis runs, expected it to end or be cancelled";
    say(Severity::error, reading_fault_);
    return {false, reading_fault_};
  }
  cancel_reading();
  reading_fault_.clear();
  reading_ = std::make_unique<ExperimentReading>(path);
  return options_.waits ? finish_reading() : Result{true, "reading " + path.string()};
}

// The data of a plant that is not there would stand in the air.
void Session::leave_experiment() {
  if (measured_->experiment() && measured_plant() < 0) measured_->close();
}

void Session::cancel_reading() {
  if (!reading_) return;
  reading_->cancel();
  dropped_.push_back(std::move(reading_));
}

Result Session::finish_reading() {
  if (!reading_) return {false, "nothing is being read"};
  while (!reading_->has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto reading = std::move(reading_);
  const Result result = adopt(*reading);
  if (!result.ok) say(Severity::error, result.text);
  reading_fault_ = result.ok ? "" : result.text;
  return result;
}

Result Session::adopt(ExperimentReading& reading) {
  const std::string path = reading.path().string();
  if (!reading.fault().empty()) return {false, path + ": " + reading.fault(), true};
  if (!reading.experiment()) return {false, reading.diagnostics().text(), true};
  if (measured_->is_diagnosing())
    return {false, path + ": a diagnosis runs, expected it to end or be cancelled"};
  const bool replaces = find_plant(document_, reading.experiment()->plant) < 0;
  if (dirty() && replaces)
    return {false, path +
                       ": its plant would take the place of changes that are not saved, expected "
                       "them to be saved or taken back"};
  for (const Diagnostic& one : reading.diagnostics().all()) say(one.severity, to_string(one));
  measured_->open(*std::move(reading.experiment()));
  if (replaces) set_document(document_of(*measured_->experiment()));
  if (options_.waits) tell_faults(measured_->wait());
  const discrepancy::Experiment& e = *measured_->experiment();
  return {true, "opened " + path + ": " + counted(e.trials.size(), "trial") + ", " +
                    counted(e.markers.size(), "marker")};
}

Result Session::accept_diagnosis() {
  const auto extended = measured_->extended_plant();
  if (!measured_->diagnosis())
    return {false, "there is no diagnosis to accept, expected one (diagnose)"};
  if (!extended)
    return {false, "nothing to accept: the diagnosis found no effect that belongs to the plant"};
  const int index = measured_plant();
  if (index < 0)
    return {false,
            "the plant that was measured is not in the document (any more), expected its curves as "
            "they were measured"};
  return run(Command("set effects",
                     {{"plant", document_.plants[static_cast<std::size_t>(index)].entry.name},
                      {"text", effects_text(extended->effects)}}));
}

void Session::tell_faults(const std::vector<std::string>& faults) {
  for (const std::string& fault : faults) say(Severity::error, "measured data: " + fault);
}

Result Session::diagnose(int threads, std::uint64_t seed) {
  measured_->start_diagnosis(threads, seed);
  if (!options_.waits) return {};
  tell_faults(measured_->wait());
  return measured_->diagnosis() ? Result{true, headline(measured_->diagnosis()->verdict)}
                                : Result{};
}

Result Session::write_report(const std::filesystem::path& folder) const {
  if (!measured_->diagnosis()) return {false, "there is no diagnosis to write, expected one"};
  write_diagnosis_files(folder, *measured_->experiment(), measured_->extended_plant(),
                        *measured_->diagnosis());
  return {};
}

}  // namespace pedicel::app
