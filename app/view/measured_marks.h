#pragma once

#include <memory>
#include <vector>

#include "app/session/live/snapshot.h"
#include "app/ui/view_state.h"
#include "engine/render/draw_list.h"

namespace pedicel::app {

class MeasuredData;
class Session;
struct MeasuredInstant;

/// The colour that stands for a model wherever it is shown.
render::Colour model_colour(int model);
/// Of what was measured.
inline constexpr render::Colour measured_colour = render::Colour::hex(0xf08a24);

/// Measured data in the picture of the scene: markers, errors, the plant as models have it.
class MeasuredMarks {
 public:
  /// Makes what add_to() adds, and says in `view` which plant it stands for and what residual its
  /// elements have.
  void update(ViewState& view, const Session& session, const Snapshot& snapshot);
  void add_to(render::DrawList& list) const;

 private:
  /// Where the elements of a plant are on its curves.
  struct Places {
    std::shared_ptr<const cosserat::RodModel> model;
    int number = -1;  // of the measured data
    std::vector<std::pair<std::string, double>> of_element;
  };
  void follow(const Session& session, const std::shared_ptr<const cosserat::RodModel>& model,
              const Pose& place_W);
  void add_model(const MeasuredData& data, const ViewState& view, int model, const Pose& place_W);
  void add_shape(const MeasuredData& data, const MeasuredInstant& instant, const ViewState& view,
                 int model, const Pose& place_W);
  void add_markers(const MeasuredInstant& instant, const MeasuredView& view, int model,
                   const Pose& place_W);

  Places places_;
  std::vector<double> stem_radii_;  // m, at each marker
  int radii_of_ = -1;               // number of the measured data
  render::DrawList list_;
};

}  // namespace pedicel::app
