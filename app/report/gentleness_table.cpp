#include "app/report/gentleness_table.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/io/csv.h"
#include "engine/io/csv_cell.h"

namespace pedicel::app {

namespace {

constexpr double least_energy = 1.0e-9;  // J, below which an organ was left alone

bool is_handled(const simulation::Gentleness::Record& one) {
  return one.touched() || one.broken || one.margin_used > 0.0 || one.strain_energy > least_energy;
}

}  // namespace

std::vector<HandledOrgan> handled_organs(const simulation::Simulation& simulation) {
  std::vector<HandledOrgan> all;
  for (int p = 0; p < simulation.rods().size(); ++p) {
    const cosserat::RodModel& model = simulation.rods().model(p);
    const auto& organs = simulation.gentleness().organs(p);
    const auto& fruits = simulation.gentleness().fruits(p);
    for (std::size_t o = 0; o < organs.size(); ++o)
      if (is_handled(organs[o])) all.push_back({model.organs[o], false, organs[o]});
    for (std::size_t f = 0; f < fruits.size(); ++f)
      if (is_handled(fruits[f]))
        all.push_back({simulation::fruit_name(model, static_cast<int>(f)), true, fruits[f]});
  }
  return all;
}

std::string to_csv(const std::vector<HandledOrgan>& organs) {
  std::string text =
      "organ,touched_at_s,peak_force_N,impulse_N_s,margin_used_1,strain_energy_J,broken\n";
  for (const HandledOrgan& one : organs) {
    const simulation::Gentleness::Record& r = one.record;
    text += io::csv_cell(one.name) + "," + (r.touched() ? io::exact_number(r.first_touch) : "nan");
    for (const double value : {r.peak_force, r.impulse, r.margin_used, r.strain_energy})
      text += "," + io::exact_number(value);
    text += r.broken ? ",1\n" : ",0\n";
  }
  return text;
}

nlohmann::ordered_json to_json(const simulation::Gentleness::Total& total,
                               const std::vector<HandledOrgan>& organs) {
  nlohmann::ordered_json json = {{"peak_force_N", total.peak_force},
                                 {"impulse_N_s", total.impulse},
                                 {"margin_used_1", total.margin_used},
                                 {"strain_energy_J", total.strain_energy},
                                 {"touched", total.touched},
                                 {"broken", total.broken},
                                 {"organs", nlohmann::ordered_json::array()}};
  for (const HandledOrgan& one : organs) {
    const simulation::Gentleness::Record& r = one.record;
    nlohmann::ordered_json entry = {{"organ", one.name},
                                    {"peak_force_N", r.peak_force},
                                    {"impulse_N_s", r.impulse},
                                    {"broken", r.broken}};
    entry["touched_at_s"] =
        r.touched() ? nlohmann::ordered_json(r.first_touch) : nlohmann::ordered_json();
    if (one.fruit)
      entry["margin_used_1"] = r.margin_used;
    else
      entry["strain_energy_J"] = r.strain_energy;
    json["organs"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace pedicel::app
