#include "plugins/discrepancy/settings/setting_rows.h"

namespace pedicel::discrepancy {

namespace {
using enum SettingKind;
}

void add_robot_alone(RobotAloneSettings& r, std::vector<DiagnosisSetting>& all) {
  SettingRows rows("robot", all);
  rows.number(
      "least_push", r.least_push, "Deviations of a sample at which a push says where it is.",
      {measured, "scenes with a known answer; no figure was kept", "Light pushes say no place."});
  rows.share("firm_share", r.firm_share, "Of the largest force: what is as strong says where, too.",
             {derived, "a push that is nearly constant stays at one place",
              "It cannot double: at 1 one sample says where."});
  rows.measure("around_break", "s", r.around_break,
               "How long before its largest jump a break may have begun.",
               {derived, "several samples of a wrist sensor", "Breaks close together are one."});
  rows.measure("break_window", "s", r.break_window,
               "Time of which samples are taken together on either side of a jump.",
               {derived, "less than a sample at 250 Hz", "Moments of breaks are less sharp."});
  rows.share("break_share", r.break_share,
             "Of the largest force until then: what must be held at a break.",
             {derived, "a touch that begins jumps, too, from nothing",
              "Breaks of light pulls are not reported."});
  rows.number("break_deviations", r.break_deviations,
              "Deviations by which force and moment must jump at once.",
              {measured, "eight stalks that part jump by 22 to 205, pushes of stems by up to 9",
               "Breaks of light pulls are not reported."});
  rows.measure("line_step", "m", r.line_step, "Step along the line of a force.",
               {derived, "below what a place is known to", "Places are found less exactly."});
  rows.measure("line_reach", "m", r.line_reach, "How far along the line a link is looked for.",
               {derived, "longer than the tools of harvest arms", "Searches take twice as long."});
  rows.measure("touching", "m", r.touching, "Distance at which the line has met a link.",
               {derived, "the coupling's own gap and a simplified shape's error",
                "Places are found a little before the surface."});
  rows.measure("near_stem", "m", r.near_stem,
               "Distance of a stem beyond which it is no place on it.",
               {derived, "what an unseen plant's place is known to",
                "Places are found on stems that were not touched."});
  rows.count(
      "places", r.places, "Places that are looked at along a curve.",
      {budget, "half a step is reported as a part of the error", "It takes a little longer."});
}

namespace {

void add_pushes(SceneSymptomSettings& s, SettingRows& rows) {
  rows.number("shows_at", s.shows_at, "Deviations at which a symptom shows.",
              {derived, "all symptoms together show by chance in less than 1 % of cases",
               "Weak symptoms are not reported."});
  rows.measure("still", "s", s.still, "Time at the start in which nothing has moved.",
               {measured, "arms of known scenes take longer to start; no figure was kept",
                "A motion that starts at once is averaged in."});
  rows.number("clear_push", s.clear_push, "Noise units of a force that is a touch.",
              {derived, "noise never reaches it", "Touches are found later."});
  rows.share("light_push", s.light_push, "Of the largest force: the same.",
             {measured, "an arm's own inertia stays below; no figure was kept",
              "Touches are found later."});
  rows.share(
      "firm_push", s.firm_push, "Of the largest force: where its ratio is read.",
      {derived, "below it the ratio is one of two noises", "Ratios are read of fewer samples."});
  rows.measure("smoothing", "s", s.smoothing, "Time to either side over which forces are smoothed.",
               {derived, "short beside a touch, long beside a sensor's samples",
                "Touches are found less exactly."});
  rows.share(
      "slip_ratio", s.slip_ratio, "Of the largest ratio: where a contact slips.",
      {derived, "one sample in twenty is a spike", "It cannot double: at 1 only spikes slip."});
}

void add_floors(SceneSymptomSettings& s, SettingRows& rows) {
  rows.measure("ratio_known_to", "1", s.ratio_known_to, "Least error of a ratio of forces.",
               {derived, "a long push would make next to nothing significant",
                "Frictions that are 0.05 off do not show."});
  rows.measure("slip_known_to", "s", s.slip_known_to, "Error of the time of a slip.",
               {measured, "contacts break loose sooner or later; no figure was kept",
                "Slips that come 0.5 s late do not show."});
  rows.measure("clock_known_to", "s", s.clock_known_to, "Least error of a delay.",
               {derived, "a long record would make next to nothing significant",
                "Delays of 1 ms do not show."});
  rows.measure("place_known_to", "m", s.place_known_to, "Least error of a plant's place.",
               {derived, "markers are glued to no less", "Shifts of 0.25 mm do not show."});
  rows.measure("pixel_known_to", "px", s.pixel_known_to, "Least error of an image's shift.",
               {derived, "a calibration is worth no more", "Shifts of 0.1 px do not show."});
  rows.measure(
      "event_known_to", "s", s.event_known_to, "Error of a recorded moment.",
      {derived, "a frame of a fast camera", "Fruits that come off 50 ms late do not show."});
}

}  // namespace

void add_scene_symptoms(SceneSymptomSettings& symptoms, std::vector<DiagnosisSetting>& all) {
  SettingRows rows("symptoms", all);
  add_pushes(symptoms, rows);
  add_floors(symptoms, rows);
}

}  // namespace pedicel::discrepancy
