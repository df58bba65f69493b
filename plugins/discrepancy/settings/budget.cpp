#include "plugins/discrepancy/settings/setting_rows.h"

namespace pedicel::discrepancy {

namespace {

using enum SettingKind;

constexpr const char* time_only = "time against the fits that were lost without it";

void add_fits(Budget& b, SettingRows& rows) {
  rows.nats("least_step", b.least_step, "A fit ends when a step gains less.",
            {derived, "a twentieth of a nat decides nothing",
             "Fits are a little shorter, and ties are decided by where they stopped."});
  rows.count("iterations", b.iterations, "The most iterations of a fit.",
             {budget, time_only, "Fits in curved valleys end nearer to their minimum."});
  rows.share(
      "baseline_horizon", b.baseline_horizon,
      "Share of the records over which the baseline and `pedicel fit` choose a start.",
      {measured,
       "periods do not slip in it, from moduli of 0.4 to 2.2 of the file's; no figure was kept",
       "A modulus far from the file's is found out of phase."});
  rows.share("candidate_horizon", b.candidate_horizon,
             "Share of the records over which candidates choose a start.",
             {measured,
              "periods do not slip in it; longer than above, because the baseline fits already; no "
              "figure was kept",
              "Large effects are found out of phase."});
  rows.count("refinements", b.refinements, "Times that mesh and step are refined.",
             {budget, "each doubles or quadruples the time of a fit",
              "Precise data of stiff plants end less often as numerical."});
}

void add_candidates(Budget& b, SettingRows& rows) {
  rows.nats("rough_step", b.rough_step, "Ends fits that only tell which candidates are ahead.",
            {budget, "a third of the clear odds", "Ties are decided by where fits stopped."});
  rows.count("first_iterations", b.first_iterations, "Iterations over the first part.",
             {budget, time_only, "Searches for large effects take longer."});
  rows.count("first_led", b.first_led,
             "Causes that symptoms speak for most clearly whose first parts are fitted before the "
             "others'.",
             {budget, time_only, "A search that is cut short has tried fewer of them."});
  rows.count("whole_iterations", b.whole_iterations,
             "Iterations of a candidate over the whole records before the leaders go on.",
             {budget, time_only, "Searches take up to twice as long."});
  rows.count("foremost", b.foremost,
             "Candidates that are fitted first, to tell how far the others are behind.",
             {budget, time_only, "More candidates are fitted before any is compared."});
  rows.count("leaders", b.leaders, "Candidates that go on to the end.",
             {budget, time_only, "Searches take longer, and fewer candidates are cut off."});
  rows.count("whole_candidates", b.whole_candidates,
             "Candidates of each list that are fitted over the whole records.",
             {budget, time_only, "Searches take up to twice as long."});
  rows.count("special_starts", b.special_starts, "Starts from the fit of a special case.",
             {budget, time_only, "Gusts and winds take longer."});
  rows.count("size_iterations", b.size_iterations, "Iterations of every start of a size.",
             {budget, time_only, "Every candidate takes longer."});
  rows.count("size_starts", b.size_starts, "Starts of a size that go on after these.",
             {budget, time_only, "Every candidate takes longer."});
  rows.count("place_iterations", b.place_iterations, "Iterations of every start of a place.",
             {budget, "between places there are ridges, where many steps are tried in vain",
              "Candidates with a place take longer."});
  rows.count("extended_iterations", b.extended_iterations,
             "Iterations of every start from a special case.",
             {budget, time_only, "Gusts and winds take longer."});
  rows.count("extended_starts", b.extended_starts,
             "Starts from a special case that go on after these.",
             {budget, time_only, "Gusts and winds take longer."});
  rows.count("fine_iterations", b.fine_iterations,
             "Iterations with the fine simulator that tell whether a candidate is near the best.",
             {budget, time_only, "Searches take longer."});
}

void add_losers(Budget& b, SettingRows& rows) {
  rows.share(
      "far_behind", b.far_behind,
      "Of the first one's gain: what a candidate needs to be fitted whole beside the leaders.",
      {budget, time_only, "Fewer candidates are fitted whole."});
  rows.nats(
      "near_by", b.near_by, "Nats within which candidates are refitted by the fine simulator.",
      {measured, "the coarse simulator's errors; no figure was kept", "More fine fits are made."});
  rows.share("near_share", b.near_share, "The same as a share of the best gain.",
             {measured, "the coarse simulator's errors at large gains; no figure was kept",
              "More fine fits of large effects are made."});
  rows.nats("large_gain", b.large_gain,
            "Nats that the best one must gain before any other is left early.",
            {measured, "below it a fit on its way from a bad start is soon as many behind",
             "Searches for large effects take longer."});
  rows.nats("lost_by", b.lost_by, "Nats behind the best at which a candidate may be left.",
            {budget, time_only, "Searches for large effects take longer."});
  rows.share("lost_share", b.lost_share,
             "Of the best gain: how far behind a converged candidate is left.",
             {budget, time_only, "Searches for large effects take longer."});
  rows.share("lost_early", b.lost_early, "The same after the first iterations.",
             {budget, "a mass and a gradient: 443 s in place of 784",
              "No candidate is left after the first iterations."});
  rows.share("lost_late", b.lost_late, "The same after twice as many.",
             {budget, time_only, "Searches for large effects take longer."});
  rows.share("lost_at_once", b.lost_at_once,
             "Of the best gain: how far behind the closest start ends a candidate.",
             {budget, time_only, "All starts of all candidates are fitted."});
}

void add_starts(Budget& b, SettingRows& rows) {
  rows.count("linear_starts", b.linear_starts, "Linear starts of a cause and either sign.",
             {budget, time_only, "Every candidate takes longer."});
  rows.count("threshold_starts", b.threshold_starts, "Linear starts of a law with a threshold.",
             {budget, time_only, "Yield and friction take longer."});
  rows.number("least_statistic", b.least_statistic,
              "Deviations below which a direction says nothing of the size.",
              {derived, "one deviation", "Fewer linear starts are made."});
  rows.share("gust_start", b.gust_start, "Of its mean: the amplitude from which a gust starts.",
             {budget, "small, so that it begins as the wind it extends",
              "Gusts start farther from the wind."});
  rows.count("ladder_rungs", b.ladder_rungs,
             "Starts of one number from which they make a ladder of thresholds.",
             {budget, time_only, "Thresholds are not looked for between starts."});
  rows.count("ladder_parts", b.ladder_parts, "Parts into which a step of the ladder is divided.",
             {budget, "a yield 0.5 % below the sharpest bend: 116 nats in place of 5",
              "Thresholds are found more closely, by twice as many simulations."});
  rows.count("ladder_rounds", b.ladder_rounds, "Times that it is divided.",
             {budget, "a 125th of a step, near enough for a fit to go on",
              "Thresholds take twice as many simulations."});
  rows.nats("ladder_tie", b.ladder_tie, "Nats within which thresholds do equally well.",
            {derived, "one deviation", "Lower thresholds are chosen."});
  rows.count("place_rounds", b.place_rounds, "Times that a place is moved along its curve.",
             {budget, time_only, "Candidates with a place take longer."});
  rows.count("instant_rounds", b.instant_rounds, "Times that a point of time is moved.",
             {budget, time_only, "Slips take longer."});
  rows.count("slide_iterations", b.slide_iterations, "Iterations from each place or point of time.",
             {budget, time_only, "Candidates with a place take longer."});
  rows.nats("worth_a_fit", b.worth_a_fit, "Nats that another place must predict for a fit.",
            {budget, "less than the clear odds", "Places end farther from the best one."});
}

void add_continuation(Budget& b, SettingRows& rows) {
  rows.number("continuation_way", b.continuation_way,
              "Deviations that a factor must be off its prior to be led back.",
              {budget, time_only, "Masses that look like density are found less often."});
  rows.share("continuation_unlike", b.continuation_unlike,
             "Of the change that the continuation makes: what the cause may leave of it.",
             {measured, "bench of hidden effects; no figure was kept",
              "More causes go back, which takes longer."});
  rows.count("continuation_starts", b.continuation_starts, "Starts of a cause that go back.",
             {budget, time_only, "Masses take longer."});
  rows.number("continuation_step", b.continuation_step, "Step on the way, of a logarithm.",
              {measured, "so that no step leaves the data by a period; no figure was kept",
               "The way takes half as long, and may be lost."});
  rows.number("continuation_hold", b.continuation_hold,
              "Deviation to which a factor is held on its way.",
              {budget, "a fifth of a step", "Factors stray farther from their way."});
  rows.count("continuation_iterations", b.continuation_iterations, "Iterations a step.",
             {budget, time_only, "Masses take longer."});
  rows.count("continuation_steps", b.continuation_steps, "The most steps.",
             {budget, "a factor of e", "Factors farther away go back in smaller steps."});
  rows.number("continuation_lost", b.continuation_lost,
              "Times the baseline's cost at which a way is lost.",
              {budget, time_only, "Ways that lead nowhere are followed longer."});
}

void add_rounds(Budget& b, SettingRows& rows) {
  rows.count("screened", b.screened, "Causes that are refitted on top of one that was found.",
             {budget, "the strongest dozen of some thirty", "Second effects take twice as long."});
  rows.count("causes", b.causes, "The most causes of a verdict.",
             {budget, "more known causes would but imitate an unknown one, slowly",
              "Unknown effects are reported as long lists of causes."});
  rows.count("bootstraps", b.bootstraps, "Samples of noise that tell the level of an alarm.",
             {budget, "the 0.995 quantile of 400: the second largest",
              "The level is known more closely; no simulation is made."});
  rows.count("junction_iterations", b.junction_iterations,
             "Iterations of a fit with junctions that give a little.",
             {budget, "a small change converges in a few", "Alarms about meshes take longer."});
  rows.count("competing_models", b.competing_models, "Models that the next experiment parts.",
             {budget, time_only, "Choosing the next experiment takes longer."});
}

void add_force_search(Budget& b, SettingRows& rows) {
  rows.count("force_places", b.force_places, "Markers at which a missing force is tried.",
             {budget, "100 short simulations a marker and trial",
              "Plants with many markers take longer."});
  rows.count("strong_places", b.strong_places, "Places where laws are tried besides two a curve.",
             {budget, time_only, "Regressions take longer; no simulation is made."});
  rows.count("law_refits", b.law_refits, "Laws that are refitted.",
             {budget, time_only, "Unknown effects take up to twice as long."});
  rows.nats("law_evidence", b.law_evidence, "Nats of linear response that a law must have.",
            {budget, "half of what is reported", "Weak forces get no law."});
  rows.nats("law_within", b.law_within, "Nats by which a law may be behind the best one.",
            {measured, "large forces are not linear", "More laws are refitted."});
  rows.share("law_share", b.law_share, "The same as a share of the best one's evidence.",
             {measured, "large forces are not linear", "More laws are refitted."});
  rows.count("law_iterations", b.law_iterations, "Iterations of such a refit.",
             {budget, "a string's numbers stand for one another: fits walk along its valley",
              "Strings take longer."});
  rows.share("law_close_share", b.law_close_share,
             "Of the best law's evidence: how near a law is refitted with its other end.",
             {measured, "a stake: 5,870 nats as a string there, 6,129 as a stop",
              "More laws are refitted."});
  rows.share("law_place_share", b.law_place_share,
             "Of a law's evidence: by how much another place of its curve may be worse.",
             {budget, time_only, "All places of the curve are looked at."});
  rows.count("law_looks", b.law_looks, "Places from which a law is fitted.",
             {budget, time_only, "Unknown effects take longer."});
  rows.count("look_iterations", b.look_iterations, "Iterations from each of them.",
             {budget, time_only, "Unknown effects take longer."});
  rows.count(
      "stop_moves", b.stop_moves, "Other places from which a stop that leaves much is fitted.",
      {measured, "a stop thirty times as stiff as its stem: the right place was third of nine",
       "Unknown effects take longer."});
}

}  // namespace

void add_budget(Budget& budget, std::vector<DiagnosisSetting>& all) {
  SettingRows rows("budget", all);
  add_fits(budget, rows);
  add_candidates(budget, rows);
  add_losers(budget, rows);
  add_starts(budget, rows);
  add_continuation(budget, rows);
  add_rounds(budget, rows);
  add_force_search(budget, rows);
}

}  // namespace pedicel::discrepancy
