// MuJoCo with a row of plants of capsules, shaken: how many steps a second. Each element is a body
// with a ball joint, a capsule and, where it carries one, a fruit's sphere; capsules of different
// plants may touch. What closes a leaf's loops is left out: a tree is what MuJoCo is best at.
//
// The plants stand as drawn: what gravity does to the joints there is taken by constant torques.
// Springs act on the joints as in mujoco.cpp, linearly implicit by damping = dt stiffness.
//
// Usage: peer_row_mujoco CAPSULES PLANTS DT SECONDS SOLVER; CAPSULES as `pedicel_row` writes it;
// SOLVER 0 PGS, 1 CG, 2 Newton. Prints one JSON object;
// "full": more touched than there was room for.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "peer.h"

namespace {

using peers::Vector3d;

constexpr double apart = 0.3;  // m
// Room for so many contacts a plant. MuJoCo 2.2 counts its bytes in an int, and takes freedoms
// times constraints of them: with 40, thirty plants are too many.
constexpr int most_contacts = 12;
// MuJoCo's own choice of its stack grows with the square of all freedoms; sparse solvers need far
// less. 1.6 GB, of which untouched pages cost nothing.
constexpr double most_stack = 2.0e8;  // numbers

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "row_mujoco: %s\n", why.c_str());
  std::exit(1);
}

struct Capsule {
  int parent = -1;
  Vector3d near = Vector3d::Zero();
  double length = 0.0;
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  double radius = 0.0, mass = 0.0, centre = 0.0;
  Vector3d inertia = Vector3d::Zero(), stiffness = Vector3d::Zero();
  double fruit = 0.0, fruit_at = 0.0;
};

std::vector<Capsule> read(const char* path) {
  std::ifstream in(path);
  if (!in) fail(std::string(path) + ": cannot be read");
  std::vector<Capsule> all;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Capsule c;
    const auto vector = [&](Vector3d& v) { words >> v[0] >> v[1] >> v[2]; };
    words >> c.parent;
    vector(c.near);
    words >> c.length >> c.turn.x() >> c.turn.y() >> c.turn.z() >> c.turn.w() >> c.radius >>
        c.mass >> c.centre;
    vector(c.inertia);
    vector(c.stiffness);
    words >> c.fruit >> c.fruit_at;
    if (!words) fail(std::string(path) + ": a line that is no capsule");
    all.push_back(c);
  }
  return all;
}

std::string text(const char* format, double a, double b = 0.0, double c = 0.0, double d = 0.0) {
  char line[200];
  std::snprintf(line, sizeof line, format, a, b, c, d);
  return line;
}

// Neighbours in the row and those after them differ in their groups; who is farther apart than
// that does not meet.
std::string touching(int plant) {
  const int group = 1 << (plant % 3);
  return " contype=\"" + std::to_string(group) + "\" conaffinity=\"" + std::to_string(7 ^ group) +
         "\"";
}

void write_body(std::string& xml, const std::vector<Capsule>& plant,
                const std::vector<std::vector<int>>& children, int p, int e) {
  const Capsule& c = plant[e];
  Vector3d start = c.near + Vector3d(p * apart, 0, 0);
  Eigen::Quaterniond turn = c.turn;
  if (c.parent >= 0) {
    const Capsule& parent = plant[c.parent];
    start = parent.turn.conjugate() * (c.near - parent.near);
    turn = parent.turn.conjugate() * c.turn;
  }
  xml +=
      "<body name=\"p" + std::to_string(p) + "_" + std::to_string(e) + "\" pos=\"" +
      text("%.15g %.15g %.15g\"", start.x(), start.y(), start.z()) +
      text(" quat=\"%.15g %.15g %.15g %.15g\">", turn.w(), turn.x(), turn.y(), turn.z()) +
      text("<inertial pos=\"0 0 %.15g\" mass=\"%.15g\" ", c.centre, c.mass) +
      text("diaginertia=\"%.15g %.15g %.15g\"/>", c.inertia.x(), c.inertia.y(), c.inertia.z()) +
      "<joint type=\"ball\"/>" +
      text("<geom type=\"capsule\" fromto=\"0 0 0 0 0 %.15g\" size=\"%.15g\"", c.length, c.radius) +
      touching(p) + "/>\n";
  if (c.fruit > 0.0)
    xml += text("<geom type=\"sphere\" pos=\"0 0 %.15g\" size=\"%.15g\"", c.fruit_at, c.fruit) +
           touching(p) + "/>\n";
  for (const int child : children[e]) write_body(xml, plant, children, p, child);
  xml += "</body>\n";
}

std::string xml_of(const std::vector<Capsule>& plant, int plants) {
  std::vector<std::vector<int>> children(plant.size());
  std::vector<int> roots;
  for (std::size_t e = 0; e < plant.size(); ++e)
    (plant[e].parent < 0 ? roots : children[plant[e].parent]).push_back(static_cast<int>(e));
  const double freedoms = 3.0 * static_cast<double>(plant.size()) * plants;
  const double stack = 5.0 * std::pow(freedoms + 4.0 * most_contacts * plants, 2.0);
  std::string xml =
      "<mujoco><compiler balanceinertia=\"true\"/>"
      "<size njmax=\"" +
      std::to_string(4 * most_contacts * plants) + "\" nconmax=\"" +
      std::to_string(most_contacts * plants) +
      (stack > most_stack ? text("\" nstack=\"%.0f", most_stack) : "") +
      "\"/>"
      "<option integrator=\"Euler\" jacobian=\"sparse\"/><worldbody>";
  for (int p = 0; p < plants; ++p)
    for (const int root : roots) write_body(xml, plant, children, p, root);
  return xml + "</worldbody></mujoco>";
}

// Compiling takes MuJoCo O(n^2), minutes for thirty plants: the result is kept in the current
// folder, by content.
mjModel* load(const std::string& xml) {
  const std::string kept = "row_" + std::to_string(std::hash<std::string>()(xml)) + ".mjb";
  if (std::ifstream(kept)) return mj_loadModel(kept.c_str(), nullptr);
  static mjVFS files;  // megabytes: not for the stack
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "row.xml", static_cast<int>(xml.size()));
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files.filedata[0]));
  char error[1000] = "";
  mjModel* model = mj_loadXML("row.xml", &files, error, sizeof error);
  mj_deleteVFS(&files);
  if (!model) fail(error);
  mj_saveModel(model, kept.c_str(), nullptr, 0);
  return model;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) fail("expected CAPSULES PLANTS DT SECONDS SOLVER");
  const std::vector<Capsule> plant = read(argv[1]);
  const int plants = std::atoi(argv[2]);
  const double dt = std::atof(argv[3]), seconds = std::atof(argv[4]);
  mjModel* model = load(xml_of(plant, plants));
  model->opt.timestep = dt;
  model->opt.solver = std::atoi(argv[5]);
  mjData* data = mj_makeData(model);
  std::vector<double> stiffness(model->nv);
  for (int p = 0; p < plants; ++p)
    for (std::size_t e = 0; e < plant.size(); ++e) {
      const std::string name = "p" + std::to_string(p) + "_" + std::to_string(e);
      const int dof = model->body_dofadr[mj_name2id(model, mjOBJ_BODY, name.c_str())];
      for (int k = 0; k < 3; ++k) {
        stiffness[dof + k] = plant[e].stiffness[k];
        model->dof_damping[dof + k] = dt * stiffness[dof + k];
      }
    }
  mj_forward(model, data);
  const std::vector<double> standing(data->qfrc_bias, data->qfrc_bias + model->nv);
  using Clock = std::chrono::steady_clock;
  constexpr int warm = 24;  // as pedicel_row
  long steps = 0;
  double passed = 0.0, contacts = 0.0;
  int most = 0;
  Clock::time_point start = Clock::now();
  bool finite = true;
  for (long i = 0; finite && (i < warm || passed < seconds); ++i) {
    if (i == warm) start = Clock::now();
    model->opt.gravity[1] = 3.0 * std::sin(2.0 * 3.14159265358979 * i * dt);
    mj_step1(model, data);
    for (int j = 0; j < model->njnt; ++j) {
      mjtNum turned[3];
      mju_quat2Vel(turned, data->qpos + model->jnt_qposadr[j], 1.0);
      for (int k = 0, dof = model->jnt_dofadr[j]; k < 3; ++k, ++dof)
        data->qfrc_applied[dof] = standing[dof] - stiffness[dof] * turned[k];
    }
    mj_step2(model, data);
    finite = data->warning[mjWARN_BADQPOS].number == 0 && data->warning[mjWARN_BADQACC].number == 0;
    if (i < warm) continue;
    ++steps;
    passed = std::chrono::duration<double>(Clock::now() - start).count();
    contacts += data->ncon;
    most = std::max(most, data->ncon);
  }
  const bool full =
      data->warning[mjWARN_CONTACTFULL].number > 0 || data->warning[mjWARN_CNSTRFULL].number > 0;
  std::printf(
      "{\"bodies\": %d, \"dofs\": %d, \"contacts\": %.1f, \"most_contacts\": %d, \"steps\": %ld, "
      "\"seconds\": %.4f, \"stable\": %s, \"full\": %s}\n",
      model->nbody - 1, model->nv, contacts / static_cast<double>(std::max(steps, 1L)), most, steps,
      passed, finite ? "true" : "false", full ? "true" : "false");
  mj_deleteData(data);
  mj_deleteModel(model);
}
