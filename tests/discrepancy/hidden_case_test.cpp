// The hidden cases themselves: the list, the same bits from the same seed, sizes in units of the
// smallest identifiable one, look-alikes that no data of theirs tell apart, and what is written.
#include "tests/discrepancy/hidden_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "plugins/plant/effect_reader.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::hidden {
namespace {

using Kind = CaseOrder::Kind;

// The first case for which `wanted` holds.
template <class Wanted>
CaseOrder first_order(const Wanted& wanted) {
  for (const CaseOrder& order : case_orders())
    if (wanted(order)) return order;
  ADD_FAILURE() << "no such case";
  return {};
}

TEST(HiddenCases, ListHoldsEveryKindAndEveryEffect) {
  std::map<Kind, int> kinds;
  std::map<std::string, int> names;
  for (const CaseOrder& order : case_orders()) {
    ++kinds[order.kind];
    if (order.kind == Kind::effect) ++names[order.hidden.front()];
  }
  EXPECT_GE(case_orders().size(), 300u);
  EXPECT_GE(kinds[Kind::null], 100);
  for (const Kind kind : {Kind::pair, Kind::look_alike, Kind::outside}) EXPECT_GE(kinds[kind], 24);
  // Those that a diagnosis looks for; outliers are found without a fit.
  for (const effects::EffectDefinition& effect : effects::effect_definitions())
    if ((effect.starts && effect.is_candidate) || effect.name == "outliers") {
      EXPECT_GE(names[effect.name], 6) << effect.name;
    }
}

// Were a size bound to one plant or one noise, the table could not tell which of them is hard.
TEST(HiddenCases, SizesMeetEveryPlantAndBothNoises) {
  std::map<std::pair<double, PlantKind>, int> plants;
  std::map<std::pair<double, bool>, int> noises;
  std::map<std::pair<PlantKind, bool>, int> both;
  for (const CaseOrder& order : case_orders()) {
    if (order.kind != Kind::effect) continue;
    ++plants[{order.size, order.plant}];
    ++noises[{order.size, order.coloured}];
    ++both[{order.plant, order.coloured}];
  }
  EXPECT_EQ(plants.size(), 6u * 4u);  // sizes 2, 3, 4, 6, 8, 16
  EXPECT_EQ(noises.size(), 6u * 2u);
  EXPECT_EQ(both.size(), 4u * 2u);
  for (const auto& [pair, count] : noises) EXPECT_GE(count, 10) << pair.first;
  for (const auto& [pair, count] : both) EXPECT_GE(count, 20) << name_of(pair.first);
}

TEST(HiddenCases, SameSeedSameBits) {
  const CaseOrder order = first_order([](const CaseOrder& o) {
    return o.kind == Kind::null && o.pack == PackKind::push && o.plant == PlantKind::stem;
  });
  const HiddenCase a = make_case(7, order), b = make_case(7, order), c = make_case(8, order);
  EXPECT_EQ(truth_text(a), truth_text(b));
  EXPECT_NE(truth_text(a), truth_text(c));
  for (std::size_t i = 0; i < a.records.size(); ++i) {
    EXPECT_EQ(a.records[i].markers, b.records[i].markers);
    EXPECT_EQ(a.records[i].force, b.records[i].force);
  }
}

// At the smallest size what a refit leaves is 5 noise units, and more of a delay leaves more in
// proportion, while it is short against the period.
TEST(HiddenCases, SizesAreMultiplesOfTheSmallest) {
  CaseOrder order;
  order.kind = Kind::effect;
  order.pack = PackKind::push;
  order.hidden = {"latency"};
  order.size = 4;
  const HiddenCase c = make_case(2, order);
  EXPECT_NEAR(c.visible[0], 20, 2);
  EXPECT_DOUBLE_EQ(c.size[0], 4 * c.smallest[0]);
  ASSERT_EQ(c.causes.size(), 1u);
  EXPECT_EQ(c.causes[0].number("delay"), c.size[0]);
  EXPECT_EQ(c.expected, Expected::named);
}

// The change (7, 3, 2, 5, 4, 1): a refit takes the first entry, another cause the second and third
// (it mixes its two effects) or the fifth (one of its two places), and what solvers differ by at
// most 2 of the fourth, of which 3 stay.
TEST(HiddenCases, DistinguishabilityLeavesWhatNoOtherCauseMakes) {
  const auto unit = [](int i) -> Eigen::VectorXd { return Eigen::VectorXd::Unit(6, i); };
  const auto along = [](int i, const char* name) {
    plant::Effect e;
    e.name = name;
    e.numbers["axis"] = {static_cast<double>(i)};
    return e;
  };
  const std::vector<OtherCause> causes{
      {"mixes", {{along(1, "mixes"), along(2, "mixes")}}},
      {"has_a_place", {{along(4, "has_a_place")}, {along(5, "has_a_place")}}}};
  const auto change = [&](const std::vector<plant::Effect>& effects) -> Eigen::VectorXd {
    // Each comes with some of what a refit takes.
    return 0.1 * unit(static_cast<int>(effects.front().number("axis"))) + 3.0 * unit(0);
  };
  Eigen::VectorXd truth(6);
  truth << 7, 3, 2, 5, 4, 1;
  const Distinguishability with(Eigen::MatrixXd(unit(0)), {2.0 * unit(3)}, causes, change);
  const Distinguishability::Nearest nearest = with.nearest(truth);
  EXPECT_EQ(nearest.cause, "has_a_place");
  EXPECT_NEAR(nearest.distance, std::sqrt(3 * 3 + 2 * 2 + 3 * 3 + 1), 1e-9);
  const Distinguishability alone(Eigen::MatrixXd(unit(0)), {2.0 * unit(3)}, {}, change);
  EXPECT_EQ(alone.nearest(truth).cause, "");
  EXPECT_NEAR(alone.nearest(truth).distance, std::sqrt(3 * 3 + 2 * 2 + 3 * 3 + 4 * 4 + 1), 1e-9);
  // Nothing is taken the other way round.
  EXPECT_NEAR(alone.nearest(-truth).distance, std::sqrt(3 * 3 + 2 * 2 + 5 * 5 + 4 * 4 + 1), 1e-9);
}

// Relaxation is told from creep and from other dampings by less than it is seen by: its smallest
// size is larger where it must be told apart, and 5 units are left beside the nearest of them.
TEST(HiddenCases, ToldApartIsMoreThanSeen) {
  CaseOrder order;
  order.kind = Kind::effect;
  order.pack = PackKind::push;
  order.hidden = {"relaxation"};
  order.size = 1;
  const HiddenCase seen = make_case(2, order);
  order.told_apart = true;
  const HiddenCase apart = make_case(2, order);
  EXPECT_NEAR(seen.visible[0], 5, 0.3);
  EXPECT_EQ(seen.nearest.cause, "");
  EXPECT_GT(apart.size[0], 1.2 * seen.size[0]);
  EXPECT_GT(apart.visible[0], apart.nearest.distance);
  EXPECT_NEAR(apart.nearest.distance, 5, 0.3);
  EXPECT_NE(apart.nearest.cause, "");
}

// AR(1) noise through its own whitening has variance 1 and no correlation.
TEST(HiddenCases, WhiteningUndoesTheColour) {
  Random random(4);
  reference::Record record;
  record.markers.resize(20000, 1);
  const Noise noise{2e-4, 0.01, 0.9};
  double n = noise.position_std * random.normal();
  for (int i = 0; i < record.markers.rows(); ++i) {
    record.markers(i, 0) = n;
    n = noise.rho * n + noise.position_std * std::sqrt(1 - 0.81) * random.normal();
  }
  const Eigen::VectorXd w = whitened({record}, noise);
  const auto size = static_cast<double>(w.size());
  EXPECT_NEAR(w.squaredNorm() / size, 1.0, 4 * std::sqrt(2 / size));
  EXPECT_NEAR(w.head(w.size() - 1).dot(w.tail(w.size() - 1)) / size, 0.0, 4 / std::sqrt(size));
}

double factor_on(const std::string& parameter, const reference::Subject& subject) {
  double product = 1;
  for (const plant::Effect& e : subject.effects)
    if (e.name == parameter) product *= e.number("factor");
  return product;
}

// A swing whose frequency tells modulus over density and whose sag tells density over modulus with
// a hundredth of the weight: factors of all three are refitted away wholly, out of phase as they
// start.
TEST(HiddenCases, RefitFollowsFar) {
  const auto predict = [](const reference::Subject& subject) {
    const double modulus = factor_on("youngs_modulus", subject);
    const double density = factor_on("density", subject);
    const double damping = factor_on("damping_time", subject);
    Eigen::VectorXd samples(500);
    for (int i = 0; i < samples.size(); ++i) {
      const double t = 0.01 * i, w = 20 * std::sqrt(modulus / density);
      samples[i] = 100 * std::exp(-0.002 * damping * w * w * t) * std::cos(w * t) + density;
    }
    return samples;
  };
  const Sight sight({}, predict, {"youngs_modulus", "density", "damping_time"});
  reference::Subject changed;
  changed.effects = {factor("youngs_modulus", 1.27), factor("density", 1.25),
                     factor("damping_time", 0.7)};
  const Sight::Change change = sight.change(changed);
  EXPECT_LT(change.rest.norm(), 0.1);
  EXPECT_NEAR(change.refit[0], std::log(1.27), 0.01);
  EXPECT_NEAR(change.refit[1], std::log(1.25), 0.01);
  EXPECT_NEAR(change.refit[2], std::log(0.7), 0.01);
}

// Two modes share their stiffness, a mass at the node of the second changes the first alone, and
// nothing measures a force: modulus and density together change nothing. A mass leaves more the
// larger it is, though next to a density without bounds it would be none.
TEST(HiddenCases, AMassStaysVisibleWhereNothingWeighs) {
  const auto predict = [](const reference::Subject& subject) {
    const double modulus = factor_on("youngs_modulus", subject);
    const double density = factor_on("density", subject);
    double mass = 0;
    for (const plant::Effect& e : subject.effects)
      if (e.name == "extra_mass") mass += e.number("mass");
    Eigen::VectorXd samples(500);
    for (int i = 0; i < samples.size(); ++i)
      samples[i] = 100 * std::cos(0.2 * i * std::sqrt(modulus / (density + mass))) +
                   30 * std::cos(1.2 * i * std::sqrt(modulus / density));
    return samples;
  };
  const Sight sight({}, predict, {"youngs_modulus", "density"});
  double before = 0;
  for (const double mass : {1e-3, 1e-2, 0.1}) {
    reference::Subject heavy;
    heavy.effects.emplace_back();
    heavy.effects[0].name = "extra_mass";
    heavy.effects[0].numbers["mass"] = {mass};
    const Sight::Change change = sight.change(heavy);
    EXPECT_GT(change.rest.norm(), before) << mass;
    EXPECT_LT(change.refit.cwiseAbs().maxCoeff(), 1) << mass;
    before = change.rest.norm();
  }
}

// size_for() on norms in closed form: proportional, with a threshold, and never reached.
TEST(HiddenCases, FindsTheSizeForALevel) {
  EXPECT_NEAR(size_for([](double u) { return 1000 * u; }, 5, 0.3, 10), 0.005, 0.05 * 0.005);
  const double beyond =
      size_for([](double u) { return u < 1 ? 0 : 50 * (u - 1) * (u - 1); }, 5, 0.1, 10);
  EXPECT_NEAR(50 * (beyond - 1) * (beyond - 1), 5, 0.3);
  EXPECT_EQ(size_for([](double u) { return u; }, 5, 0.1, 2), 2);
}

TEST(HiddenCases, LookAlikesAreAlike) {
  for (const char* truth : {"base_compliance", "youngs_modulus"}) {
    const HiddenCase c = make_case(3, first_order([&](const CaseOrder& o) {
                                     return o.kind == Kind::look_alike && o.hidden[0] == truth;
                                   }));
    EXPECT_LT(c.sine, 0.1) << truth;
    EXPECT_EQ(c.expected, Expected::ambiguous);
    EXPECT_GT(c.visible[0], 10) << truth;
    EXPECT_GE(c.look_alikes.size(), 2u);
  }
}

TEST(HiddenCases, FolderGivesNothingAway) {
  const TemporaryFolder folder;
  HiddenCase c = make_case(5, first_order([](const CaseOrder& o) {
                             return o.kind == Kind::outside && o.pack == PackKind::push &&
                                    o.plant == PlantKind::stem;
                           }));
  write_case(folder / "", c);
  Diagnostics diagnostics;
  const auto plant = plant::read_plant_file(c.folder / "plant.yaml", diagnostics);
  ASSERT_TRUE(plant) << diagnostics.text();
  EXPECT_EQ(*plant, c.setting.plant);
  EXPECT_TRUE(plant->effects.empty());
  const io::CsvTable table =
      io::read_csv(c.folder / c.trials[0].name / "markers.csv", {}, diagnostics);
  EXPECT_EQ(static_cast<int>(table.rows.size()), c.records[0].markers.rows());
  EXPECT_EQ(static_cast<int>(table.columns.size()), 1 + c.records[0].markers.cols());
  const std::string text = io::read_file(c.folder / "experiment.yaml");
  EXPECT_EQ(text.find(c.order.hidden[0] + ":"), std::string::npos);
  EXPECT_EQ(text.find("effects"), std::string::npos);
  EXPECT_EQ(io::read_file((folder / c.name).string() + ".truth.json"), truth_text(c));
  EXPECT_EQ(c.expected, Expected::unknown);
  EXPECT_EQ(c.outside.size(), 1u);
}

}  // namespace
}  // namespace pedicel::hidden
