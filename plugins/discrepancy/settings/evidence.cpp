#include "plugins/discrepancy/settings/setting_rows.h"

namespace pedicel::discrepancy {

namespace {

using enum SettingKind;

void add_competition(Evidence& e, SettingRows& rows) {
  rows.share("margin_share", e.margin_share,
             "Of the best gain: what a competing model must lose by besides the clear odds.",
             {measured, "of 230 single effects the true one was at most 3.7 nats behind, at 800",
              "More verdicts of large effects are ambiguous."});
  rows.nats("most_margin", e.most_margin, "The most that this share may come to.",
            {measured, bench, "More verdicts of very large effects are ambiguous."});
  rows.number(
      "most_margins", e.most_margins,
      "Margins by which a model with a few more numbers may be behind that explains as well.",
      {measured, bench, "More causes with many numbers stay in the set."});
  rows.share("limit_reach", e.limit_reach,
             "Of an unknown: how near its bound a cause has turned into another one.",
             {measured, bench, "More causes are reported as the limit of another one."});
  rows.share("solvers_agree", e.solvers_agree,
             "Of what a cause changes: the part to which two honest solvers agree.",
             {measured,
              "of a weak segment that changes 245 noise units 7 are left, of a soft foot of 474, 6",
              "A second cause beside a large first one is missed."});
  rows.count("more_numbers", e.more_numbers,
             "Numbers that a model may have more and still explain as well.",
             {measured, "the offsets of a force sensor, three, follow anything",
              "Sensors compete with every cause."});
}

void add_held_out(Evidence& e, SettingRows& rows) {
  rows.number("held_out_change", e.held_out_change,
              "Noise units in all: a smaller change of the held-out trials refutes nothing.",
              {derived, "three deviations", "More causes are accepted without being checked."});
  rows.share("held_out_share", e.held_out_share,
             "Of the expected gain on held-out trials: what a cause must bring there.",
             {derived, "an amplitude of 0.6: the gain of an amplitude a is 2 a - 1",
              "An amplitude of 0.7 is asked for; more verdicts are unknown."});
  rows.number("held_out_chance", e.held_out_chance,
              "Deviations that noise may take off the gain on held-out trials.",
              {derived, "95 % of chance", "More causes carry over that do not."});
}

void add_several(Evidence& e, SettingRows& rows) {
  rows.share("family_share", e.family_share,
             "Of the first cause's gain: what another one of its family must bring.",
             {measured, "two implementations of one law differ by less",
              "Two effects of one family are never both named."});
  rows.number("beyond_linear", e.beyond_linear,
              "Times that a cause may gain what its direction predicts.",
              {measured, bench, "Searches for another cause are made more often, in vain."});
  rows.number("much_left", e.much_left,
              "Mean square in noise units: what the best cause leaves when a force is asked for "
              "before any further cause.",
              {measured, "bench of hidden effects: twice the noise in RMS",
               "Forces outside the list are reported as several causes, slowly."});
  rows.share("left_by_force", e.left_by_force,
             "Of what the best cause leaves: the most that a force may leave to take its place.",
             {measured, bench, "Forces take the place of two effects more often."});
  rows.number("far_from_data", e.far_from_data,
              "Mean square in noise units above which the baseline misses the data: searches then "
              "start far from it.",
              {measured, bench, "Large effects are searched for by linear starts alone."});
}

void add_forces(Evidence& e, SettingRows& rows) {
  rows.nats("beyond_doubt", e.beyond_doubt,
            "Nats with which one cause that leaves nothing is not held against a force.",
            {measured, bench, "More diagnoses take the time of a search for a force."});
  rows.nats("beyond_doubt_together", e.beyond_doubt_together,
            "The same of several causes together.",
            {measured, "a force that several causes imitate leaves something there",
             "More diagnoses take the time of a search for a force."});
  rows.share(
      "force_share", e.force_share,
      "Of what known causes gain: what one force may gain less or must gain more.",
      {measured, bench,
       "Forces take the place of several causes more often, and of single ones less often."});
  rows.share(
      "worthwhile_force", e.worthwhile_force,
      "Of the causes' gain: what a force of any history must predict for its law to be looked for.",
      {measured, bench, "Forces are hardly ever looked for beside causes."});
  rows.share("too_alike", e.too_alike,
             "Cosine at which a decoy is the change itself and shows nothing.",
             {derived, "a gain of 90 % is no decoy's own",
              "It cannot double: nearer to 1 constant offsets fail by their decoys."});
}

void add_discretisation(Evidence& e, SettingRows& rows) {
  rows.number(
      "discretisation", e.discretisation,
      "Of the compliance of a branch's first half segment: what a junction may give by its mesh.",
      {derived, "a mesh of half the spacing gives 0.5, and 10 % more",
       "Soft junctions of real plants are taken for meshes."});
  rows.number("most_discretisation", e.most_discretisation,
              "The most that a fit of this compliance may find.",
              {derived, "beyond what any mesh does", "Such fits take a little longer."});
}

void add_stalks(Evidence& e, SettingRows& rows) {
  rows.number("stalk_scatter", e.stalk_scatter, "Least scatter of the strengths of stalks.",
              {measured, "what simulated loads err by",
               "Laws of detachment need more fruits to be named."});
  rows.number("threshold_error", e.threshold_error,
              "Deviation of a factor common to all thresholds of a plant file.",
              {measured, "what thresholds are known to and loads are right to; no figure was kept",
               "Thresholds that are 20 % off are no finding."});
  rows.share("impossible_break", e.impossible_break, "Probability of a break that a law forbids.",
             {derived, "14 nats a break: what cannot be costs much, not all",
              "One odd break refutes a law a little less."});
}

}  // namespace

void add_evidence(Evidence& evidence, std::vector<DiagnosisSetting>& all) {
  SettingRows rows("evidence", all);
  add_competition(evidence, rows);
  add_held_out(evidence, rows);
  add_several(evidence, rows);
  add_forces(evidence, rows);
  add_discretisation(evidence, rows);
  add_stalks(evidence, rows);
}

}  // namespace pedicel::discrepancy
