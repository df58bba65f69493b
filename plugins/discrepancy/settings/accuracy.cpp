#include "plugins/discrepancy/settings/setting_rows.h"

namespace pedicel::discrepancy {

namespace {

using enum SettingKind;

void add_errors(Accuracy& a, SettingRows& rows) {
  rows.share("allowed_error", a.allowed_error,
             "Of the noise: our own error before it is corrected for.",
             {measured, bench,
              "Precise data are simulated more coarsely, and false alarms get likelier."});
  rows.share("allowed_coarse", a.allowed_coarse,
             "The same where nodes or steps are coarser than usual.",
             {measured, bench, "Coarse meshes and steps are kept more often."});
  rows.share("masked_error", a.masked_error,
             "Of what the model leaves: an error that is masked and needs no finer mesh.",
             {measured, "what is left is twenty times as large",
              "Models far from the data are simulated more coarsely."});
  rows.share("masked_verdict", a.masked_verdict,
             "Of what the model leaves: an error that is masked and does not end the diagnosis.",
             {measured, "what is left is ten times as large", "Fewer diagnoses end as numerical."});
  rows.number("numerical_limit", a.numerical_limit,
              "Of the noise: our own error above which the verdict is numerical.",
              {measured, bench, "Fewer diagnoses end as numerical, with false names among them."});
  rows.share(
      "left_uncorrected", a.left_uncorrected, "Of a correction by Richardson: what it may leave.",
      {measured, bench, "Statistics along our own error count for less, and intervals widen."});
  rows.number("coarse_error", a.coarse_error,
              "Of the noise: what searches may carry along as a correction.",
              {measured, "what wins is refitted by the fine simulator",
               "Searches are faster, and more of their fits end beside the minimum."});
  rows.share("coarse_share", a.coarse_share, "The same as a share of what the model leaves.",
             {measured, "what is left is twenty times as large",
              "Searches for large effects are faster."});
  rows.number("coarsest_mesh", a.coarsest_mesh,
              "Times the plant file's distance between nodes that a search may use.",
              {measured, "on a coarser one a weak stretch is shorter than a segment",
               "Places of weak segments are 0.5 off, and end as unknown."});
}

void add_steps(Accuracy& a, SettingRows& rows) {
  rows.seconds("usual_dt", a.usual_dt, "Step of fits; twice as long ones are tried first.",
               {measured, "markers err by 17 um rms at a release",
                "Fits take half the time, and fast plants are refined more often."});
  rows.count("quiet_steps", a.quiet_steps,
             "Steps that are taken as one where no instrument sees anything move.",
             {measured, "page of measurements, diagnosis: time",
              "Trials with long rests take less time, and small swings in them are damped."});
  rows.seconds("design_dt", a.design_dt, "Least step of trials that could be done next.",
               {budget, "the choice needs no more accuracy than the models' own",
                "The next experiment is chosen in half the time."});
}

void add_directions(Accuracy& a, SettingRows& rows) {
  rows.number("direction_change", a.direction_change,
              "Noise units in all that a direction is moved by.",
              {measured, "well above the solver's tolerance, and still a small change",
               "Directions are less linear."});
  rows.number("most_change", a.most_change, "Noise units above which it is moved anew.",
              {measured, bench, "Directions are less linear, with fewer simulations."});
  rows.number("full_size", a.full_size, "Times that a start is larger than the first look at it.",
              {budget, "most starts are then in range", "More directions are moved anew."});
  rows.number("seen", a.seen,
              "Noise units that a parameter must move a sample by when it changes by a tenth.",
              {derived, "a hundred samples show it", "Fewer parameters are fitted."});
  rows.number(
      "plainly_seen", a.plainly_seen,
      "The same of a parameter that is added when the noise is read anew.",
      {measured,
       "more than above, because the noise was read by a model without it; no figure was kept",
       "A modulus that was taken for noise stays at its nominal value."});
  rows.number("shift_step", a.shift_step, "Logarithm of a factor that shifts are measured by.",
              {measured, bench, "Corrections are less linear."});
  rows.number("usual_shift", a.usual_shift, "Deviation of factors by our own errors.",
              {measured, bench, "Corrections of what data hardly show get larger."});
}

void add_tests(Accuracy& a, SettingRows& rows) {
  rows.number("own_amplitude", a.own_amplitude,
              "Times the amplitude of our own error that is taken off the residual power.",
              {measured, bench, "Effects outside the list are seen from a larger size on."});
  rows.count("motion_shapes", a.motion_shapes, "The most shapes of motion of a plant.",
             {measured, bench, "Noise counts as motion, and the test gets weaker."});
  rows.count("power_neighbourhood", a.power_neighbourhood,
             "Frequencies to either side that tell the noise's own power.",
             {derived, "forty degrees of freedom a channel and more",
              "The noise's colour is followed less closely."});
  rows.share("least_across", a.least_across,
             "Of a unit vector: what makes a direction across the curve.",
             {derived, "three degrees", "Strings along a curve are not tried as stops."});
  rows.number("far_end", a.far_end, "Lengths of the plant at which a near end is looked for first.",
              {budget, "fits go on from there", "Near ends are found a little later."});
}

}  // namespace

void add_accuracy(Accuracy& accuracy, std::vector<DiagnosisSetting>& all) {
  SettingRows rows("accuracy", all);
  add_errors(accuracy, rows);
  add_steps(accuracy, rows);
  add_directions(accuracy, rows);
  add_tests(accuracy, rows);
}

}  // namespace pedicel::discrepancy
