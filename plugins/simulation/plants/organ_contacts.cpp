#include "plugins/simulation/plants/organ_contacts.h"

#include <cmath>
#include <map>
#include <tuple>

#include "plugins/cosserat/solver/canopy.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::simulation {

namespace {

// A fruit by its own name, a stem or leaf by its organ's.
std::string name_of(const cosserat::RodModel& model, int shape) {
  const cosserat::CollisionShape& one = model.shapes[shape];
  if (one.fruit >= 0) return fruit_name(model, one.fruit);
  return model.organs[model.elements[one.element].organ];
}

}  // namespace

std::vector<OrganContact> organ_contacts(const cosserat::RodSystem& rods) {
  std::map<std::tuple<int, std::string, std::string>, OrganContact> pairs;
  for (int p = 0; p < rods.size(); ++p)
    for (const cosserat::ContactForce& contact : rods.contact_forces(p)) {
      if (!cosserat::is_other_plant(contact.point.collider)) continue;
      const cosserat::JoinedModel::Shape other = rods.touched(contact.point.collider);
      if (other.plant < p) continue;  // its own side says the same
      const std::string organ = name_of(rods.model(p), contact.point.shape);
      const std::string against = name_of(rods.model(other.plant), other.shape);
      OrganContact& pair = pairs[{p, organ, against}];
      pair.organ = organ;
      pair.other = against;
      pair.normal += contact.normal;
      pair.tangential += contact.tangential_W.norm();
      pair.force_W += contact.normal * contact.point.normal_W + contact.tangential_W;
    }
  std::vector<OrganContact> all;
  all.reserve(pairs.size());
  for (auto& [key, pair] : pairs) all.push_back(std::move(pair));
  return all;
}

OrganContactLog::OrganContactLog(const std::filesystem::path& file, double rate)
    : table_(file, {"time_s", "organ", "other", "normal_N", "tangential_N", "force_x_N",
                    "force_y_N", "force_z_N"}),
      rate_(rate) {
  table_.flush();
}

void OrganContactLog::observe(double time, const cosserat::RodSystem& rods) {
  // As world::Recorder: the small addition keeps 0.1 from falling short of its own multiple.
  const long due = static_cast<long>(std::floor(time * rate_ + 1e-9));
  if (due == last_due_) return;
  last_due_ = due;
  for (const OrganContact& pair : organ_contacts(rods)) {
    std::vector<std::string> cells = {io::format_number(time), pair.organ, pair.other};
    for (const double value :
         {pair.normal, pair.tangential, pair.force_W.x(), pair.force_W.y(), pair.force_W.z()})
      cells.push_back(io::format_number(value));
    table_.text_row(cells);
  }
  table_.flush();
}

}  // namespace pedicel::simulation
