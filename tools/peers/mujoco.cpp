// MuJoCo: ball joints. Its Euler step takes joint damping D implicitly, (M + h D) a = f - D v, so
// springs of stiffness K with D = h K are linearly implicit: K acts on q + h v', v' the velocity at
// the end of the step. Its own joint springs are the same about all axes; ours, in qfrc_applied,
// tell bending from twisting. Drag is -rate M v.
#include <mujoco/mujoco.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>

#include "peer.h"

namespace {

using namespace peers;

std::string text(const char* format, double a, double b, double c, double d = 0.0) {
  char line[200];
  std::snprintf(line, sizeof line, format, a, b, c, d);
  return line;
}

std::string name_of(int plant, int element) {
  return "p" + std::to_string(plant) + "_" + std::to_string(element);
}

void write_body(std::string& xml, const std::vector<std::vector<int>>& children, const Plant& plant,
                int p, int e) {
  const Element& element = plant[e];
  const Eigen::Quaterniond q(element.frame_P);
  xml +=
      "<body name=\"" + name_of(p, e) + "\" pos=\"" +
      text("%.15g %.15g %.15g\"", element.start_P.x(), element.start_P.y(), element.start_P.z()) +
      text(" quat=\"%.15g %.15g %.15g %.15g\">", q.w(), q.x(), q.y(), q.z()) +
      text("<inertial pos=\"0 0 %.15g\" mass=\"%.15g\" ", 0.5 * element.length, element.mass, 0.0) +
      text("diaginertia=\"%.15g %.15g %.15g\"/>", element.inertia.x(), element.inertia.y(),
           element.inertia.z()) +
      "<joint type=\"ball\"/>\n";
  for (int child : children[e]) write_body(xml, children, plant, p, child);
  xml += "</body>\n";
}

std::string xml_of(const std::vector<Plant>& plants) {
  std::string xml =
      "<mujoco><compiler boundmass=\"0\" boundinertia=\"0\"/>"
      "<option integrator=\"Euler\"><flag constraint=\"disable\" contact=\"disable\"/></option>"
      "<worldbody>";
  for (std::size_t p = 0; p < plants.size(); ++p) {
    std::vector<std::vector<int>> children(plants[p].size());
    for (std::size_t e = 1; e < plants[p].size(); ++e) children[plants[p][e].parent].push_back(e);
    write_body(xml, children, plants[p], p, 0);
  }
  return xml + "</worldbody></mujoco>";
}

// Compiling takes MuJoCo O(n^2), half a minute for the tree: the result is kept in the current
// folder, by content.
mjModel* load(const std::string& xml) {
  const std::string kept = "mujoco_" + std::to_string(std::hash<std::string>()(xml)) + ".mjb";
  if (std::ifstream(kept)) return mj_loadModel(kept.c_str(), nullptr);
  static mjVFS files;  // megabytes: not for the stack
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "plants.xml", static_cast<int>(xml.size()));
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files.filedata[0]));
  char error[1000] = "";
  mjModel* model = mj_loadXML("plants.xml", &files, error, sizeof error);
  mj_deleteVFS(&files);
  if (!model) {
    std::fprintf(stderr, "mujoco: %s\n", error);
    std::exit(1);
  }
  mj_saveModel(model, kept.c_str(), nullptr, 0);
  return model;
}

class MujocoWorld : public World {
 public:
  MujocoWorld(const std::vector<Plant>& plants, double dt)
      : model_(load(xml_of(plants))), data_(mj_makeData(model_)), plants_(plants) {
    model_->opt.timestep = dt;
    stiffness_.resize(model_->nv);
    inertial_.resize(model_->nv);
    for (std::size_t p = 0; p < plants.size(); ++p) {
      bodies_.emplace_back();
      for (std::size_t e = 0; e < plants[p].size(); ++e) {
        const int body = mj_name2id(model_, mjOBJ_BODY, name_of(p, e).c_str());
        bodies_[p].push_back(body);
        for (int k = 0; k < 3; ++k) {
          const int dof = model_->body_dofadr[body] + k;
          stiffness_[dof] = plants[p][e].stiffness[k];
          model_->dof_damping[dof] = dt * stiffness_[dof];
        }
      }
    }
  }
  ~MujocoWorld() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  void set_environment(double gravity, double drag) override {
    model_->opt.gravity[2] = -gravity;
    drag_ = drag;
  }
  void step() override {
    mj_step1(model_, data_);
    mj_mulM(model_, data_, inertial_.data(), data_->qvel);
    for (int j = 0; j < model_->njnt; ++j) {
      mjtNum turned[3];
      mju_quat2Vel(turned, data_->qpos + model_->jnt_qposadr[j], 1.0);
      for (int k = 0, dof = model_->jnt_dofadr[j]; k < 3; ++k, ++dof)
        data_->qfrc_applied[dof] = -stiffness_[dof] * turned[k] - drag_ * inertial_[dof];
    }
    mj_step2(model_, data_);
  }
  // mj_step leaves the frames of the step's start; the next call's first phase renews them.
  Vector3d end(int plant, int element) const override {
    mj_kinematics(model_, data_);
    const int body = bodies_[plant][element];
    const mjtNum *x = data_->xpos + 3 * body, *m = data_->xmat + 9 * body;
    const double length = plants_[plant][element].length;
    return {x[0] + length * m[2], x[1] + length * m[5], x[2] + length * m[8]};
  }

 private:
  mjModel* model_;
  mjData* data_;
  std::vector<Plant> plants_;
  std::vector<std::vector<int>> bodies_;
  std::vector<double> stiffness_;  // N m/rad, per degree of freedom
  std::vector<double> inertial_;   // M v
  double drag_ = 0.0;              // 1/s
};

}  // namespace

int main(int argc, char** argv) {
  return run(argc, argv, [](const std::vector<Plant>& plants, double dt) {
    return std::make_unique<MujocoWorld>(plants, dt);
  });
}
