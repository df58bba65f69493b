#include "plugins/discrepancy/procedure/diagnosis_log.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

std::function<void(const std::string&, double)> rising(
    std::function<void(const std::string&, double)> to) {
  if (!to) return {};
  struct Highest {
    std::mutex mutex;
    double share = 0.0;
  };
  // Shared, because a function is copied.
  return [to = std::move(to), highest = std::make_shared<Highest>()](const std::string& what,
                                                                     double share) {
    // Held while `to` runs: else a thread with a higher share could overtake it there.
    const std::lock_guard lock(highest->mutex);
    highest->share = std::max(highest->share, std::min(share, 1.0));
    to(what, highest->share);
  };
}

// Shares are those of the time that one named cause takes; a second cause takes about as long
// again.
void DiagnosisLog::say(const std::string& what, double share) const {
  if (progress_) progress_(what, share);
}

void DiagnosisLog::note(const std::string& sentence) {
  steps_.push_back(sentence);
  if (found_) found_(sentence);
}

void DiagnosisLog::settings(DiagnosisSettings settings) {
  DiagnosisSettings defaults;
  const std::vector<DiagnosisSetting> own = described(settings), usual = described(defaults);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i].get() != usual[i].get())
      note("Setting " + own[i].name +
           text(" is %.6g in place of %.6g.", own[i].get(), usual[i].get()));
}

void DiagnosisLog::noise(const DataSet& data) {
  const auto said = [](const Noise& noise) {
    return text("%.3g, lag-one correlation %.2g", noise.std, noise.correlation());
  };
  note("Noise of positions (m) " + said(data.position_noise()) + "; of forces (N) " +
       said(data.force_noise()) + ".");
}

void DiagnosisLog::fit(const std::string& what, const FitSummary& fit, int samples) {
  std::string sentence = what + text(": %.6g per sample", 2.0 * fit.cost / std::max(1, samples));
  for (int p = 0; p < fit.hypothesis.size(); ++p) {
    const FreeParameter& free = fit.hypothesis.free[p];
    sentence +=
        ", " + fit.hypothesis.effects[free.effect].name + " " + free.name +
        text(" %.5g +- %.2g", fit.hypothesis.value(p),
             fit.standard_error[p] * (free.logarithmic ? fit.hypothesis.value(p) : free.scale));
  }
  note(sentence + ".");
}

void DiagnosisLog::directions(std::vector<Direction> directions, const Alarm& alarm) {
  note(text("Largest directed statistic %.3g, level %.3g.", alarm.statistic, alarm.level));
  const ResidualPower& left = alarm.residual_power;
  if (left.trial >= 0)
    note(text("Left in the plant's shapes of motion: %.3g deviations,", left.deviations) +
         left.frequency() +
         (left.in_all ? " of all trials." : " of trial " + std::to_string(left.trial + 1) + "."));
  std::ranges::stable_sort(directions, [](const Direction& a, const Direction& b) {
    return std::abs(a.statistic) > std::abs(b.statistic);
  });
  for (std::size_t i = 0; i < std::min<std::size_t>(8, directions.size()); ++i)
    note("  " + directions[i].cause +
         text(": %.3g, of which our own error may be %.3g", directions[i].statistic,
              directions[i].systematic));
}

}  // namespace pedicel::discrepancy
