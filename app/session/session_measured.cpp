#include "pedicel/app/session/session_measured.h"

#include <chrono>
#include <thread>

#include "pedicel/app/session/commands/measured_commands.h"
#include "pedicel/app/session/measured/diagnosis_card.h"
#include "pedicel/app/session/measured/experiment_reading.h"
#include "pedicel/app/session/measured/measured_data.h"
#include "pedicel/app/session/session.h"
#include "pedicel/app/session/session_files.h"
#include "pedicel/core/check.h"
#include "pedicel/discrepancy/report/report.h"
#include "pedicel/io/atomic_file.h"

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

SessionMeasured::SessionMeasured(Session& session, SessionCore& core)
    : session_(session), core_(core), data_(std::make_unique<MeasuredData>()) {}

SessionMeasured::~SessionMeasured() = default;

int SessionMeasured::plant() const {
  const discrepancy::Experiment* experiment = data_->experiment();
  return experiment ? find_plant(core_.editor.document(), experiment->plant) : -1;
}

Result SessionMeasured::open(const std::filesystem::path& path) {
  if (data_->is_diagnosing()) {
    reading_fault_ = path.string() + ": a diagnosis runs, expected it to end or be cancelled";
    core_.messages.say(Severity::error, reading_fault_);
    return {false, reading_fault_};
  }
  cancel_reading();
  reading_fault_.clear();
  reading_ = std::make_unique<ExperimentReading>(path);
  return core_.options.waits ? finish_reading() : Result{true, "reading " + path.string()};
}

// The data of a plant that is not there would stand in the air.
void SessionMeasured::leave() {
  if (data_->experiment() && plant() < 0) data_->close();
}

void SessionMeasured::cancel_reading() {
  if (!reading_) return;
  reading_->cancel();
  dropped_.push_back(std::move(reading_));
}

Result SessionMeasured::finish_reading() {
  if (!reading_) return {false, "nothing is being read"};
  while (!reading_->has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto reading = std::move(reading_);
  const Result result = adopt(*reading);
  if (!result.ok) core_.messages.say(Severity::error, result.text);
  reading_fault_ = result.ok ? "" : result.text;
  return result;
}

Result SessionMeasured::adopt(ExperimentReading& reading) {
  const std::string path = reading.path().string();
  if (!reading.fault().empty()) return {false, path + ": " + reading.fault(), true};
  if (!reading.experiment()) return {false, reading.diagnostics().text(), true};
  if (data_->is_diagnosing())
    return {false, path + ": a diagnosis runs, expected it to end or be cancelled"};
  const bool replaces = find_plant(core_.editor.document(), reading.experiment()->plant) < 0;
  if (session_.files().dirty() && replaces)
    return {false, path +
                       ": its plant would take the place of changes that are not saved, expected "
                       "them to be saved or taken back"};
  core_.messages.say_remarks(reading.diagnostics());
  data_->open(*std::move(reading.experiment()));
  if (replaces) session_.files().begin(document_of(*data_->experiment()));
  if (core_.options.waits) tell_faults(data_->wait());
  const discrepancy::Experiment& e = *data_->experiment();
  return {true, "opened " + path + ": " + counted(e.trials.size(), "trial") + ", " +
                    counted(e.markers.size(), "marker")};
}

Result SessionMeasured::accept_diagnosis() {
  const auto extended = data_->extended_plant();
  if (!data_->diagnosis())
    return {false, "there is no diagnosis to accept, expected one (diagnose)"};
  if (!extended)
    return {false, "nothing to accept: the diagnosis found no effect that belongs to the plant"};
  const int index = plant();
  if (index < 0)
    return {false,
            "the plant that was measured is not in the document (any more), expected its curves as "
            "they were measured"};
  return session_.run(Command(
      "set effects",
      {{"plant", core_.editor.document().plants[static_cast<std::size_t>(index)].entry.name},
       {"text", effects_text(extended->effects)}}));
}

void SessionMeasured::update() {
  std::erase_if(dropped_, [](const auto& one) { return one->has_ended(); });
  if (reading_ && reading_->has_ended()) finish_reading();
  tell_faults(data_->update());
}

void SessionMeasured::tell_faults(const std::vector<std::string>& faults) {
  for (const std::string& fault : faults)
    core_.messages.say(Severity::error, "measured data: " + fault);
}

Result SessionMeasured::diagnose(int threads, std::uint64_t seed) {
  data_->start_diagnosis(threads, seed);
  if (!core_.options.waits) return {};
  tell_faults(data_->wait());
  return data_->diagnosis() ? Result{true, headline(data_->diagnosis()->verdict)} : Result{};
}

Result SessionMeasured::write_report(const std::filesystem::path& folder) const {
  if (!data_->diagnosis()) return {false, "there is no diagnosis to write, expected one"};
  write_diagnosis_files(folder, *data_->experiment(), data_->extended_plant(), *data_->diagnosis());
  return {};
}

}  // namespace pedicel::app
