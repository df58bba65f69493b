#include "plugins/discrepancy/fit/fit_parts.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace pedicel::discrepancy {

namespace {

using Json = nlohmann::json;

// JSON has no word for what is not finite.
Json of_number(double value) {
  // Finite numbers need no word of ours: the library writes them so that they come back to the bit.
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double to_number(const Json& json) {
  if (json.is_number()) return json.get<double>();
  // Standard errors are infinite where data leave a number open, so such words do come.
  const auto word = json.get<std::string>();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return word == "inf" ? infinity : word == "-inf" ? -infinity : std::nan("");
}

// In the order of memory, with both sizes: a Jacobian of thousands of rows takes no name a number.
Json of_matrix(const Eigen::MatrixXd& matrix) {
  Json numbers = Json::array();
  for (Eigen::Index i = 0; i < matrix.size(); ++i) numbers.push_back(of_number(matrix.data()[i]));
  return {{"rows", matrix.rows()}, {"columns", matrix.cols()}, {"numbers", numbers}};
}

Eigen::MatrixXd to_matrix(const Json& json) {
  Eigen::MatrixXd matrix(json.at("rows").get<Eigen::Index>(),
                         json.at("columns").get<Eigen::Index>());
  const Json& numbers = json.at("numbers");
  // An answer comes from another process and may be cut off. Eigen would read on behind its end.
  if (std::cmp_not_equal(numbers.size(), matrix.size()))
    throw std::runtime_error("a matrix has other numbers than its size says");
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    matrix.data()[i] = to_number(numbers[static_cast<std::size_t>(i)]);
  return matrix;
}

Json of_effect(const plant::Effect& effect) {
  Json json = {{"name", effect.name}, {"words", effect.words}, {"numbers", Json::object()}};
  for (const auto& [name, values] : effect.numbers) {
    json["numbers"][name] = Json::array();
    for (const double value : values) json["numbers"][name].push_back(of_number(value));
  }
  // Absent where an effect has no place: an empty name would be a curve that the plant lacks.
  if (effect.place) json["curve"] = effect.place->curve, json["at"] = of_number(effect.place->at);
  return json;
}

plant::Effect to_effect(const Json& json) {
  plant::Effect effect;
  effect.name = json.at("name");
  effect.words = json.at("words").get<std::map<std::string, std::string>>();
  for (const auto& [name, values] : json.at("numbers").items())
    for (const Json& value : values) effect.numbers[name].push_back(to_number(value));
  if (json.contains("curve")) {
    effect.place.emplace();
    effect.place->curve = json.at("curve");
    effect.place->at = to_number(json.at("at"));
  }
  return effect;
}

// Every field, since the fit that follows is to go on as if it had been made here. One that is
// forgotten would come back with its default, in silence.
Json of_free(const FreeParameter& free) {
  return {{"effect", free.effect},
          {"name", free.name},
          {"component", free.component},
          {"logarithmic", free.logarithmic},
          {"scale", of_number(free.scale)},
          {"low", of_number(free.low)},
          {"high", of_number(free.high)},
          {"unit", free.unit},
          {"prior", of_number(free.prior)},
          {"prior_centre", of_number(free.prior_centre)},
          // By number: both ends are the same program.
          {"vanishes", static_cast<int>(free.vanishes)},
          {"nominal", of_number(free.nominal)},
          {"heading_of", free.heading_of}};
}

FreeParameter to_free(const Json& json) {
  FreeParameter free;
  free.effect = json.at("effect");
  free.name = json.at("name");
  free.component = json.at("component");
  free.logarithmic = json.at("logarithmic");
  free.scale = to_number(json.at("scale"));
  free.low = to_number(json.at("low"));
  free.high = to_number(json.at("high"));
  free.unit = json.at("unit");
  free.prior = to_number(json.at("prior"));
  free.prior_centre = to_number(json.at("prior_centre"));
  free.vanishes = static_cast<Vanishes>(json.at("vanishes").get<int>());
  free.nominal = to_number(json.at("nominal"));
  free.heading_of = json.at("heading_of");
  return free;
}

// With residual and derivatives, large as they are: they would else be simulated again.
Json of_fit(const FitSummary& fit) {
  Json json = {{"name", fit.hypothesis.name},
               {"effects", Json::array()},
               {"free", Json::array()},
               {"cost", of_number(fit.cost)},
               {"residual", of_matrix(fit.residual)},
               {"jacobian", of_matrix(fit.jacobian)},
               {"standard_error", of_matrix(fit.standard_error)},
               {"condition", of_number(fit.condition)},
               {"at_bound", fit.at_bound},
               {"spread", of_number(fit.spread)},
               {"samples", fit.samples},
               {"converged", fit.converged},
               {"why", fit.why}};
  for (const plant::Effect& effect : fit.hypothesis.effects)
    json["effects"].push_back(of_effect(effect));
  for (const FreeParameter& free : fit.hypothesis.free) json["free"].push_back(of_free(free));
  return json;
}

FitSummary to_fit(const Json& json) {
  FitSummary fit;
  fit.hypothesis.name = json.at("name");
  for (const Json& effect : json.at("effects")) fit.hypothesis.effects.push_back(to_effect(effect));
  for (const Json& free : json.at("free")) fit.hypothesis.free.push_back(to_free(free));
  fit.cost = to_number(json.at("cost"));
  fit.residual = to_matrix(json.at("residual"));
  fit.jacobian = to_matrix(json.at("jacobian"));
  fit.standard_error = to_matrix(json.at("standard_error"));
  fit.condition = to_number(json.at("condition"));
  fit.at_bound = json.at("at_bound").get<std::vector<int>>();
  fit.spread = to_number(json.at("spread"));
  fit.samples = json.at("samples");
  fit.converged = json.at("converged");
  fit.why = json.at("why");
  return fit;
}

Json of_end(const ProfileEnd& end) {
  return {{"unknown", of_number(end.unknown)}, {"at_bound", end.at_bound}, {"refits", end.refits}};
}

ProfileEnd to_end(const Json& json) {
  return {to_number(json.at("unknown")), json.at("at_bound"), json.at("refits")};
}

template <class Made>
Made parsed(const std::string& text, Made (*make)(const Json&)) {
  try {
    return make(Json::parse(text));
  } catch (const Json::exception& fault) {
    // Whatever JSON finds wrong is told as what it means here.
    throw std::runtime_error(std::string("a part of a search has no answer: ") + fault.what());
  }
}

Profile to_profile(const Json& json) {
  // Ends as unknowns, and not as values: what asked goes on to compute with them.
  Profile profile{to_end(json.at("low")), to_end(json.at("high")), {}};
  // A better fit ends the round of whoever asked, so it comes back whole.
  if (json.contains("better")) profile.better = to_fit(json.at("better"));
  return profile;
}

}  // namespace

std::string to_text(const FitSummary& fit) {
  return of_fit(fit).dump();
}

FitSummary fit_of_text(const std::string& text) {
  return parsed(text, to_fit);
}

std::string to_text(const Profile& profile) {
  Json json = {{"low", of_end(profile.low)}, {"high", of_end(profile.high)}};
  if (profile.better) json["better"] = of_fit(*profile.better);
  return json.dump();
}

Profile profile_of_text(const std::string& text) {
  return parsed(text, to_profile);
}

std::vector<FitSummary> fits_by(FitParts* parts, const std::string& stage, int count,
                                const std::function<FitSummary(int)>& one) {
  std::vector<FitSummary> fits;
  if (!parts)
    // Without a text in between: as text and back no bit is lost, so both ways give the same fits.
    for (int i = 0; i < count; ++i) fits.push_back(one(i));
  else
    for (const std::string& text :
         parts->answers(stage, count, [&](int i) { return to_text(one(i)); }))
      fits.push_back(fit_of_text(text));
  return fits;
}

std::vector<Profile> profiles_by(FitParts& parts, const std::string& stage, int count,
                                 const std::function<Profile(int)>& one) {
  std::vector<Profile> profiles;
  for (const std::string& text :
       parts.answers(stage, count, [&](int i) { return to_text(one(i)); }))
    profiles.push_back(profile_of_text(text));
  return profiles;
}

}  // namespace pedicel::discrepancy
