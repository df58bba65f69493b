#include "plugins/discrepancy/settings/setting_rows.h"

namespace pedicel::discrepancy {

namespace {

using enum SettingKind;

void add_odds(Levels& l, SettingRows& rows) {
  rows.nats("clear_odds", l.clear_odds, "Nats by which a competing model must lose.",
            {derived, "odds of 20 to 1; \"strong\" in Kass and Raftery 1995",
             "More verdicts are ambiguous, and the true cause is left out less often."});
  rows.nats("clear_margin", l.clear_margin,
            "Nats for what overrules the ranking: a trial left out, a decoy, a sensor in place of "
            "a force, a force in place of several causes.",
            {derived, "odds of 150 to 1; \"very strong\" in Kass and Raftery 1995",
             "The ranking is overruled less often."});
  rows.nats("outside_evidence", l.outside_evidence,
            "Nats that something from outside the list of causes must be worth: a missing force, a "
            "law of detachment.",
            {derived, "odds of 3,000 to 1, because many places and laws are tried",
             "Fewer forces and laws of detachment are reported."});
  rows.nats("worth_naming", l.worth_naming, "Nats that a named cause must be worth.",
            {measured,
             "two honest solvers differ by up to 15; an effect of twice the size that could just "
             "be seen is worth 30 or more",
             "Small effects end as unknown, and false names get rarer."});
  rows.nats("as_well", l.as_well, "Nats by which a model that explains as well may be worse.",
            {derived, "odds below 3 to 1 say nothing", "More verdicts are ambiguous."});
  rows.nats(
      "one_deviation", l.one_deviation,
      "Nats of a number that is one deviation from where its cause turns into another.",
      {derived, "half of chi-square 1", "Fewer causes are reported as the limit of another one."});
}

void add_alarms(Levels& l, SettingRows& rows) {
  rows.number("least_alarm", l.least_alarm,
              "Deviations that the largest directed statistic must reach, whatever noise does.",
              {measured, "differences between two solvers reach 4, what is worth a name 10",
               "Effects below twice the smallest visible size pass as adequate."});
  rows.share("alarm_quantile", l.alarm_quantile,
             "Share of data without any effect whose largest statistic raises no alarm.",
             {derived, "one false alarm in 200",
              "It cannot double: 0.9975 halves the false alarms that noise raises."});
  rows.number("residual_power", l.residual_power,
              "Deviations of the residual power along the shapes of motion that raise an alarm.",
              {derived, "5 for some hundred bands, and 1 for noise that is not as modelled",
               "Effects outside the list of causes pass as adequate."});
  rows.number("winsorised_at", l.winsorised_at,
              "Noise units to which residuals are winsorised before their power is taken.",
              {derived, "one normal sample in 16,000 lies beyond", "Outliers look like motion."});
  rows.number("held_out_deviations", l.held_out_deviations,
              "Deviations by which a held-out trial must exceed the noise to object.",
              {derived, "as for residual power", "What acts in a held-out trial alone is missed."});
  rows.share("held_out_excess", l.held_out_excess,
             "Of the noise's square: the least excess with which a held-out trial objects.",
             {measured, "bench of hidden effects; no figure was kept",
              "Weak effects in held-out trials alone are missed."});
  rows.number("held_out_worse", l.held_out_worse,
              "Times the error without it at which a force or a refit makes held-out trials worse.",
              {derived, "chance moves the error of some hundred samples by 5 %",
               "Forces are reported that hold for the fitted trials only."});
  rows.number(
      "impossible_force", l.impossible_force,
      "Times the measured force that a model may need at a hold before the drive is refused.",
      {derived, "moduli of plants are known to a factor of ten",
       "A path in the wrong place is taken for a missing effect."});
  rows.number("impossible_refit", l.impossible_refit,
              "Times that force which the refitted model must need for that, too.",
              {derived, "a modulus that was far off is mended by the refit",
               "A path in the wrong place is taken for a missing effect."});
}

void add_parameters(Levels& l, SettingRows& rows) {
  rows.number("needed_deviations", l.needed_deviations,
              "Deviations from 1 at which a factor on modulus, density or damping is named.",
              {derived, "three parameters share the few false alarms that are allowed",
               "Small errors of the plant file are not reported."});
  rows.number("least_factor_change", l.least_factor_change,
              "Logarithm of a factor that two honest solvers may differ by.",
              {measured, "moduli of two solvers differ by up to 0.1 % on the same data",
               "Moduli that are 0.3 % off are not reported, however precise the data."});
  rows.share("known_to", l.known_to,
             "How far from its nominal value modulus, density or damping may be without being a "
             "finding, where the plant file says nothing (`known_to`).",
             {derived, "materials are seldom measured to less than 1 %",
              "Fewer numbers of the plant file are reported as off."});
  rows.share(
      "least_share", l.least_share,
      "Share of the misfit that a further cause must explain; what explains less is reported as "
      "a detail.",
      {derived, "fifty times less than all of it changes no decision",
       "Fewer causes stand beside the first."});
  rows.number("believed", l.believed, "Deviations of its prior within which a factor is believed.",
              {derived, "95 % of what is known beforehand",
               "A mass that looks like density is searched for less often."});
  rows.number("prior_conflict", l.prior_conflict,
              "Deviations of its prior at which a factor says that this is another plant.",
              {derived, "one in 16,000 of what is known beforehand",
               "Missing forces are sought about a plant that a force has distorted."});
  rows.number("beyond_mesh", l.beyond_mesh,
              "Largest statistic that the way branches are meshed may explain.",
              {measured, "such alarms are about what no mesh hides; no figure was kept",
               "Large alarms cost one more fit each before the search."});
}

void add_remainders(Levels& l, SettingRows& rows) {
  rows.share("small_excess", l.small_excess,
             "Of the noise's square: what is left without being a sign of a missing effect.",
             {measured, "bench of hidden effects; no figure was kept",
              "More small remainders are accepted."});
  rows.share("missed_share", l.missed_share,
             "Of the gain: what the largest remaining direction may still gain.",
             {measured, "bench of hidden effects; no figure was kept",
              "More remainders are accepted beside a large first effect."});
  rows.share("remainder_share", l.remainder_share,
             "Of what was above the noise: what may be left of it.",
             {measured, "bench of hidden effects; no figure was kept",
              "More verdicts stay named although something is left."});
  rows.number("separating", l.separating,
              "Noise units in all that the next experiment must part two models by.",
              {derived, "18 nats, as much as a named cause is worth",
               "Larger or longer trials are proposed."});
  rows.share("outlier_share", l.outlier_share, "Share of samples from which outliers are named.",
             {measured, "a swing that starts within a sample makes a few",
              "Fewer sensors are reported to have outliers."});
  rows.count("outlier_count", l.outlier_count, "Samples from which outliers are named.",
             {measured, "a swing that starts within a sample makes a few",
              "Outliers of short records are not named."});
  rows.count("broken_stalks", l.broken_stalks,
             "Fruits that must have come off before a law of detachment is fitted.",
             {derived, "a law has up to four numbers", "Few experiments are judged at all."});
}

}  // namespace

void add_levels(Levels& levels, std::vector<DiagnosisSetting>& all) {
  SettingRows rows("levels", all);
  add_odds(levels, rows);
  add_alarms(levels, rows);
  add_parameters(levels, rows);
  add_remainders(levels, rows);
}

}  // namespace pedicel::discrepancy
