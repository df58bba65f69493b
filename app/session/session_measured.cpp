#include "app/session/session_measured.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/session/commands/measured_commands.h"
#include "app/session/measured/diagnosis_card.h"
#include "app/session/measured/experiment_reading.h"
#include "app/session/measured/measured_data.h"
#include "app/session/measured/measured_scene.h"
#include "app/session/session.h"
#include "app/session/session_files.h"
#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/report/report.h"
#include "plugins/discrepancy/report/scene_diagnosis_files.h"

namespace pedicel::app {

namespace {

/// The experiment's plant alone, to be looked at and changed; the experiment keeps its own.
Document document_of(const discrepancy::Experiment& experiment) {
  Document document = empty_document();
  DocumentPlant one;
  one.entry.name = experiment.plant().name;
  one.file = std::make_shared<const plant::PlantFile>(experiment.plant());
  document.plants.push_back(std::move(one));
  stand_on_ground(document);
  return document;
}

/// The experiment's scene with its plants, to be looked at and changed; the experiment keeps its
/// own files.
Document scene_document(const discrepancy::Experiment& experiment, Diagnostics& remarks) {
  Document document = app::document_of(experiment.scene, remarks);
  for (DocumentPlant& one : document.plants)
    if (one.file) one.entry.file.clear();
  return document;
}

/// Whether a document has all plants of a scene, under their names.
bool has_plants(const Document& document, const discrepancy::Experiment& experiment) {
  return document.scene->robot.has_value() &&
         std::ranges::all_of(experiment.plants, [&](const discrepancy::ExperimentPlant& plant) {
           const int index = document.plant_index(plant.name);
           if (index < 0) return false;
           const auto& file = document.plants[static_cast<std::size_t>(index)].file;
           return file && file->curves == plant.file.curves && file->root == plant.file.root;
         });
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
    : session_(session),
      core_(core),
      data_(std::make_unique<MeasuredData>()),
      scene_(std::make_unique<MeasuredScene>()) {}

SessionMeasured::~SessionMeasured() = default;

int SessionMeasured::plant() const {
  const discrepancy::Experiment* experiment = data_->experiment();
  return experiment ? find_plant(core_.editor.document(), experiment->plant()) : -1;
}

bool SessionMeasured::has_scene() const {
  return scene_->experiment() && has_plants(core_.editor.document(), *scene_->experiment());
}

bool SessionMeasured::is_diagnosing() const {
  return data_->is_diagnosing() || scene_->is_diagnosing();
}

DiagnosisProgress SessionMeasured::progress() const {
  return scene_->is_diagnosing() ? scene_->progress() : data_->progress();
}

DiagnosisCard SessionMeasured::card() const {
  if (scene_->diagnosis()) return card_of(*scene_->diagnosis());
  return data_->diagnosis() ? card_of(*data_->diagnosis()) : DiagnosisCard{};
}

std::filesystem::path SessionMeasured::folder() const {
  if (scene_->experiment()) return scene_->experiment()->folder;
  return data_->experiment() ? data_->experiment()->folder : std::filesystem::path{};
}

Result SessionMeasured::open(const std::filesystem::path& path) {
  if (is_diagnosing()) {
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
  if (scene_->experiment() && !has_scene()) scene_->close();
}

void SessionMeasured::close() {
  data_->close();
  scene_->close();
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
  if (is_diagnosing())
    return {false, path + ": a diagnosis runs, expected it to end or be cancelled"};
  if (reading.experiment()->has_robot()) return adopt_scene(reading);
  const bool replaces = find_plant(core_.editor.document(), reading.experiment()->plant()) < 0;
  if (session_.files().dirty() && replaces)
    return {false, path +
                       ": its plant would take the place of changes that are not saved, expected "
                       "them to be saved or taken back"};
  core_.messages.say_remarks(reading.diagnostics());
  scene_->close();
  data_->open(*std::move(reading.experiment()));
  if (replaces) session_.files().begin(document_of(*data_->experiment()));
  if (core_.options.waits) tell_faults(data_->wait());
  const discrepancy::Experiment& e = *data_->experiment();
  return {true, "opened " + path + ": " + counted(e.trials.size(), "trial") + ", " +
                    counted(e.markers.size(), "marker")};
}

Result SessionMeasured::adopt_scene(ExperimentReading& reading) {
  const std::string path = reading.path().string();
  const bool replaces = !has_plants(core_.editor.document(), *reading.experiment());
  if (session_.files().dirty() && replaces)
    return {false, path +
                       ": its scene would take the place of changes that are not saved, expected "
                       "them to be saved or taken back"};
  core_.messages.say_remarks(reading.diagnostics());
  Diagnostics remarks;
  if (replaces) session_.files().begin(scene_document(*reading.experiment(), remarks));
  core_.messages.say_remarks(remarks);
  data_->close();
  scene_->open(*std::move(reading.experiment()));
  if (core_.options.waits) tell_faults(scene_->wait());
  const discrepancy::Experiment& e = *scene_->experiment();
  return {true, "opened " + path + ": " + counted(e.trials.size(), "trial") + ", " +
                    counted(e.markers.size(), "marker") + ", " +
                    counted(e.cameras.size(), "camera") + ", " +
                    counted(e.wrenches.size(), "wrench sensor")};
}

SessionMeasured::Acceptance SessionMeasured::acceptance() const {
  using enum Acceptance;
  const Document& document = core_.editor.document();
  if (scene_->experiment()) {
    const std::vector<plant::Effect> found = scene_->found_effects();
    if (found.empty() || !has_scene()) return impossible;
    // Read as the command reads them, so that both are written alike.
    Diagnostics none;
    const std::string wanted = scene_effects_text(
        parse_scene_effects(scene_effects_text(scene_->experiment()->scene.effects, found), none));
    return scene_effects_text(document.scene->effects) == wanted ? accepted : possible;
  }
  const auto extended = data_->extended_plant();
  const int index = plant();
  if (!extended || index < 0) return impossible;
  return document.plants[static_cast<std::size_t>(index)].file->effects == extended->effects
             ? accepted
             : possible;
}

Result SessionMeasured::accept_scene() {
  const std::vector<plant::Effect> found = scene_->found_effects();
  if (!scene_->diagnosis())
    return {false, "there is no diagnosis to accept, expected one (diagnose)"};
  if (found.empty())
    return {false, "nothing to accept: the diagnosis found no effect that a run of the scene has"};
  if (!has_scene())
    return {false,
            "the scene that was measured is not in the document (any more), expected its robot and "
            "its plants as they were measured"};
  return session_.run(
      Command("set scene effects",
              {{"text", scene_effects_text(scene_->experiment()->scene.effects, found)}}));
}

Result SessionMeasured::accept_diagnosis() {
  if (scene_->experiment()) return accept_scene();
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
  tell_faults(scene_->update());
  count_diagnoses();
}

void SessionMeasured::count_diagnoses() {
  const void* of_data = data_->diagnosis();
  const void* of_scene = scene_->diagnosis();
  if (of_data == last_of_data_ && of_scene == last_of_scene_) return;
  last_of_data_ = of_data, last_of_scene_ = of_scene;
  ++diagnoses_;
}

void SessionMeasured::tell_faults(const std::vector<std::string>& faults) {
  for (const std::string& fault : faults)
    core_.messages.say(Severity::error, "measured data: " + fault);
}

Result SessionMeasured::diagnose(int threads, std::uint64_t seed) {
  if (scene_->experiment())
    scene_->start_diagnosis(threads);
  else
    data_->start_diagnosis(threads, seed);
  if (!core_.options.waits) return {};
  tell_faults(scene_->experiment() ? scene_->wait() : data_->wait());
  count_diagnoses();
  if (scene_->diagnosis()) return {true, headline(scene_->diagnosis()->verdict)};
  return data_->diagnosis() ? Result{true, headline(data_->diagnosis()->verdict)} : Result{};
}

Result SessionMeasured::write_report(const std::filesystem::path& folder) const {
  if (scene_->diagnosis()) {
    discrepancy::SceneDiagnosis found = *scene_->diagnosis();
    std::filesystem::create_directories(folder);
    discrepancy::write_scene_diagnosis(folder, *scene_->experiment(), found);
    return {};
  }
  if (!data_->diagnosis()) return {false, "there is no diagnosis to write, expected one"};
  write_diagnosis_files(folder, *data_->experiment(), data_->extended_plant(), *data_->diagnosis());
  return {};
}

}  // namespace pedicel::app
