#include "plugins/discrepancy/settings/setting_rows.h"

namespace pedicel::discrepancy {

namespace {

using enum SettingKind;

constexpr const char* known_scenes = "scenes with a known answer; no figure was kept";
constexpr const char* scene_time = "time against what more of them found; no figure was kept";

void add_limits(SceneSearchSettings& s, SettingRows& rows) {
  rows.number("floor", s.floor, "Noise units beyond the noise that a model may leave.",
              {measured, "what two honest solvers of one scene differ by; no figure was kept",
               "Small effects pass as adequate."});
  rows.share("solvers_share", s.solvers_share, "The same as a share of the misfit.",
             {measured, "as the floor: solvers differ by more where more moves",
              "A second cause beside a large first one is missed."});
  rows.number("held_out_allowance", s.held_out_allowance,
              "Times as much that a model may leave of trials held out.",
              {measured, known_scenes, "What acts in a held-out trial alone is missed."});
  rows.number(
      "clean_allowance", s.clean_allowance,
      "Floors that the baseline may leave of a trial in which nothing else acts.",
      {measured, known_scenes, "The baseline is fitted to trials with an outside force in them."});
  rows.number("least_gain", s.least_gain,
              "Mean square beyond the noise that a cause must take away.",
              {measured, "half of the floor's square", "Small causes end as unknown."});
  rows.number("number_price", s.number_price,
              "Share of the mean square that each further number must take away.",
              {measured, known_scenes, "Causes with fewer numbers win more often."});
}

void add_competition(SceneSearchSettings& s, SettingRows& rows) {
  rows.number(
      "tie_share", s.tie_share,
      "Of the mean square that the best leaves: by how much a competing model may be worse.",
      {measured, known_scenes, "More verdicts are ambiguous."});
  rows.number(
      "least_tie", s.least_tie, "The least that this comes to.",
      {measured, "a sixth of the floor's square", "More verdicts of small effects are ambiguous."});
  rows.number(
      "behind", s.behind,
      "Times the best misfit: where a cause is no longer refitted by its linear prediction.",
      {budget, scene_time, "More causes are refitted."});
  rows.share("halfway", s.halfway,
             "Of the misfit: what a cause must leave at most to be fitted on.",
             {budget, scene_time, "It cannot double: at 1 every cause is fitted on."});
  rows.share("renewed_share", s.renewed_share,
             "Of the misfit: what must be left for the noise of predictions to be settled.",
             {budget, scene_time, "It cannot double: at 1 the noise is taken anew once."});
  rows.share("shorter_step", s.shorter_step,
             "Of a linear step: where a cause is tried beside the whole step.",
             {budget, "a contact bends the way after a touch; no figure was kept",
              "Causes far from linear start too far away."});
  rows.nats("decoy_margin", s.decoy_margin, "Nats by which decoys must gain less than the change.",
            {derived, "`levels.clear_margin`", "More named causes end as unknown."});
  rows.share("too_alike", s.too_alike,
             "Cosine at which a decoy is the change itself and shows nothing.",
             {derived, "`evidence.too_alike`",
              "It cannot double: nearer to 1 constant offsets fail by their decoys."});
}

void add_material(SceneSearchSettings& s, SettingRows& rows) {
  rows.number(
      "named_deviations", s.named_deviations,
      "Deviations at which a number of a plant's file, or a competing model, is reported as off.",
      {derived, "one in 370 by chance", "Small errors of the plant file are not reported."});
  rows.number("modulus_known_to", s.modulus_known_to,
              "Logarithm of a modulus: what a file's own number is known to.",
              {measured, "what two solvers make of it; no figure was kept",
               "Moduli that are 10 % off are not reported."});
  rows.number("density_known_to", s.density_known_to, "The same of a density.",
              {measured, "it is seen through little but weight; no figure was kept",
               "Densities that are 20 % off are not reported."});
  rows.number("damping_known_to", s.damping_known_to, "The same of a damping time.",
              {measured, "what solvers differ by most; no figure was kept",
               "Damping times that are 100 % off are not reported."});
  rows.measure(
      "least_displacement", "m", s.least_displacement,
      "How far an unseen plant must stand from its file's place to be a finding.",
      {derived, "no pot is placed by hand to less", "Displacements of 5 mm are not reported."});
  rows.measure("farthest_start", "m", s.farthest_start,
               "The farthest place to which an unseen plant is put before the first fit.",
               {measured, "half of what its place is known to",
                "Displacements of a few millimetres have no start near by."});
}

void add_effort(SceneSearchSettings& s, SettingRows& rows) {
  rows.measure("mesh", "m", s.mesh, "Distance between nodes in the search.",
               {budget, "its own error counts as noise", "Searches are faster and less sharp."});
  rows.seconds("dt", s.dt, "Step of the search.",
               {budget, "its own error counts as noise", "Searches are faster and less sharp."});
  rows.seconds("run_dt", s.run_dt, "The same where a log of a run was measured.",
               {measured, "what an impact does in a step is a needle that no fit finds from afar",
                "A plant 3 mm off is reported as 2.87 mm off, beside a density that is not; at "
                "half as 2.71."});
  rows.count("baseline_iterations", s.baseline_iterations, "Iterations of the baseline.",
             {budget, scene_time, "Plants far from their files are fitted more slowly."});
  rows.count("first_iterations", s.first_iterations, "Iterations of a cause.",
             {budget, scene_time, "Searches take longer."});
  rows.count("last_iterations", s.last_iterations, "Further ones of a cause that came near.",
             {budget, scene_time, "Searches take longer."});
  rows.count("polishing", s.polishing, "Iterations with the mesh that judges.",
             {budget, "the search has found the valley", "The last fit takes longer."});
  rows.measure(
      "rest_stretch", "s", s.rest_stretch,
      "How long what a model leaves is taken to keep its sign, for intervals.",
      {derived, "a part of a touch", "Intervals are wider, and less sure of their width."});
  rows.count("renewals", s.renewals,
             "Times that the noise of predictions is taken anew for an unseen plant's place.",
             {budget, scene_time, "Such diagnoses take longer."});
  rows.count("tried", s.tried, "Causes whose linear prediction is tried in full.",
             {budget, scene_time, "Searches take longer."});
  rows.count("plant_starts", s.plant_starts,
             "Starts of effects of the plants' own models whose derivatives are taken.",
             {budget, "each is a simulation of every trial for each of its numbers",
              "Searches take longer."});
  rows.count("starts_of_each", s.starts_of_each, "Of one such effect at most.",
             {budget, "two places, or a soft and a stiff one", "Fewer effects are among them."});
  rows.number(
      "left_files", s.left_files,
      "Logarithm of a baseline's factor from which on they are begun at the files' own, too.",
      {budget, "nearer than that the linear finds its way",
       "A cause that the modulus took over halfway is begun from there alone."});
  rows.count("refits", s.refits,
             "Causes refitted in the first round, and as many of fewer numbers; half in the next.",
             {budget, scene_time, "Searches take up to twice as long."});
  rows.count(
      "causes", s.causes, "The most causes together.",
      {measured, "of a harvest with three things hidden two leave 2.5 noise units, three 0.25",
       "Searches that end as unknown take longer."});
}

}  // namespace

void add_scene_search(SceneSearchSettings& search, std::vector<DiagnosisSetting>& all) {
  SettingRows rows("search", all);
  add_limits(search, rows);
  add_competition(search, rows);
  add_material(search, rows);
  add_effort(search, rows);
}

void add_scene_fit(SceneFitSettings& f, std::vector<DiagnosisSetting>& all) {
  SettingRows rows("fit", all);
  rows.number("wanted_change", f.wanted_change,
              "Noise units in all that a difference should amount to.",
              {measured, "far above contacts that begin a step earlier; no figure was kept",
               "Derivatives are less linear."});
  rows.step("first_step", f.first_step, "Of an unknown: the first difference.",
            {budget, "it is changed after the first look", "First derivatives are less linear."});
  rows.step("least_step", f.least_step, "The smallest difference.",
            {derived, "above the solver's tolerance", "Precise numbers have coarser derivatives."});
  rows.step("least_place_step", f.least_place_step,
            "The smallest difference of an unseen plant's place: of a unit step, 2 mm.",
            {measured, "a stem that sticks to the tool changes as much by a micrometre",
             "Where such a plant stands is reported as more certain than it is."});
  rows.step("most_step", f.most_step, "The largest difference.",
            {derived, "a third of a unit step still bends little",
             "Numbers that show little have less linear derivatives."});
  rows.step("screen_factor_step", f.screen_factor_step,
            "Logarithm of a factor by which a cause is first looked at.",
            {measured, "a tenth of what is known: contacts need more than a trifle",
             "Linear predictions of factors are less linear."});
  rows.step("screen_step", f.screen_step, "The same of other numbers, of their unit step.",
            {measured, "the unit step of a start is what is seen",
             "It cannot double: half of it is masked by contacts."});
  rows.nats("least_gain", f.least_gain, "A fit ends when a step gains less.",
            {derived, "half a nat decides nothing", "Fits are a little shorter."});
  rows.number("density_prior", f.density_prior,
              "Deviation of the logarithm of a plant's density; 0: not known.",
              {derived, "what swings freely shows modulus over density alone",
               "Masses are fitted as densities more often."});
  rows.number(
      "damping_prior", f.damping_prior, "The same of the damping time.",
      {derived, "a factor of e either way is usual", "Damping that hardly shows wanders farther."});
  rows.measure("place_known_to", "m", f.place_known_to,
               "Deviation of an unseen plant's place from its file's.",
               {derived, "what a pot is placed to by hand", "Such a place wanders farther."});
  rows.measure("yaw_known_to", "rad", f.yaw_known_to, "The same of its turn about the vertical.",
               {derived, "what a pot is turned to by hand", "Such a turn wanders farther."});
}

void add_outside_force(OutsideForceSettings& o, std::vector<DiagnosisSetting>& all) {
  SettingRows rows("outside", all);
  rows.measure("spacing", "m", o.spacing, "Distance of the places that are tried along a curve.",
               {budget, scene_time, "Places are found less exactly, in half the time."});
  rows.count("places", o.places, "The most places; beyond them they are farther apart.",
             {budget, scene_time, "Large plants take longer."});
  rows.measure("bin", "s", o.bin, "Time over which the force is one.",
               {derived, "short beside a hand's pull, with several samples in it",
                "The course is found less exactly, with less noise."});
  rows.measure("rise", "s", o.rise, "Time in which a tried force begins.",
               {derived, "slow beside the first swing of a stem", "Sudden forces begin late."});
  rows.measure("least_response", "m", o.least_response,
               "Least that a tried force moves a place by.",
               {measured, "contacts that stick hide less; no figure was kept",
                "Contacts slide in the response that stick in the data."});
  rows.measure("most_response", "m", o.most_response, "Most that it moves a place by.",
               {measured, "stems are linear that far; no figure was kept",
                "Large forces are reported as smaller ones."});
  rows.number("significant_bin", o.significant_bin,
              "Mean square in noise units of a bin that is not noise alone.",
              {derived, "a bin has some ten samples", "Forces begin later."});
  rows.number("clear_force", o.clear_force, "Deviations at which a bin has a force.",
              {derived, "one in 65,000 by chance, of three components",
               "Weak parts of a pull are left out."});
  rows.share("peak_share", o.peak_share, "Of the largest force: what counts as acting.",
             {measured, known_scenes, "Pulls are reported as shorter."});
  rows.share("onset_share", o.onset_share, "The same where it begins.",
             {measured, "a pull begins small", "Pulls begin later."});
  rows.share("least_share", o.least_share,
             "Of the misfit: what a force must explain to be reported.",
             {measured, known_scenes, "Forces at a place are reported less often."});
  rows.share("weak_axis", o.weak_axis,
             "Of the response: what is added across the axis that hardly moves.",
             {measured, "along a stem nearly nothing moves; no figure was kept",
              "Forces along a stem come out too small."});
}

}  // namespace pedicel::discrepancy
