// MuJoCo with a robot arm from its URDF, alone or beside a stem of ball joints: how many steps a
// second. The arm is held by servos (torque towards the start, with implicit joint damping), as an
// arm that stands is. Usage: peer_arm_mujoco URDF DT SEGMENTS SECONDS SOLVER; SEGMENTS 0: no stem;
// SOLVER 0 PGS, 1 CG, 2 Newton. Prints one JSON object.
#include <mujoco/mujoco.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "arm_mujoco: %s\n", why.c_str());
  std::exit(1);
}

std::string read(const std::string& path) {
  std::ifstream in(path);
  if (!in) fail(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

mjModel* load(const std::string& xml, const std::string& name) {
  static mjVFS files;  // megabytes: not for the stack
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, name.c_str(), static_cast<int>(xml.size()));
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files.filedata[0]));
  char error[1000] = "";
  mjModel* model = mj_loadXML(name.c_str(), &files, error, sizeof error);
  mj_deleteVFS(&files);
  if (!model) fail(error);
  return model;
}

// A stem of 0.5 m in front of the arm, 3 mm thick, 1e9 Pa. MuJoCo takes damping implicitly, so
// damping = dt stiffness makes its springs linearly implicit. The stem may touch the arm, and not
// itself.
std::string stem_of(int segments, double dt) {
  constexpr double radius = 0.0015, modulus = 1.0e9, density = 900.0, pi = 3.14159265358979;
  const double length = 0.5 / segments;
  const double stiffness = modulus * 0.25 * pi * radius * radius * radius * radius / length;
  std::string xml, end;
  for (int i = 0; i < segments; ++i) {
    char line[400];
    std::snprintf(line, sizeof line,
                  "<body pos=\"%g 0 %g\"><joint type=\"ball\" stiffness=\"%g\" damping=\"%g\"/>"
                  "<geom type=\"capsule\" fromto=\"0 0 0 0 0 %g\" size=\"%g\" density=\"%g\" "
                  "contype=\"2\" conaffinity=\"1\"/>\n",
                  i == 0 ? -0.35 : 0.0, i == 0 ? 0.2 : length, stiffness, dt * stiffness, length,
                  radius, density);
    xml += line;
    end += "</body>";
  }
  return xml + end;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) fail("expected URDF DT SEGMENTS SECONDS SOLVER");
  const std::string urdf = argv[1];
  const double dt = std::atof(argv[2]), seconds = std::atof(argv[4]);
  const int segments = std::atoi(argv[3]), solver = std::atoi(argv[5]);
  // What is only seen is left out, and collision shapes of neighbouring links do not touch.
  std::string text = read(urdf);
  const std::size_t robot = text.find("<robot"), open = text.find('>', robot);
  text.insert(open + 1, "<mujoco><compiler discardvisual=\"true\" fusestatic=\"true\"/></mujoco>");
  mj_deleteModel(load(text, "arm.urdf"));
  char error[1000] = "";
  const std::string saved = "arm_mujoco.xml";
  if (!mj_saveLastXML(saved.c_str(), nullptr, error, sizeof error)) fail(error);
  std::string arm = read(saved);
  if (segments > 0) arm.insert(arm.rfind("</worldbody>"), stem_of(segments, dt));
  mjModel* model = load(arm, "scene.xml");
  model->opt.timestep = dt;
  model->opt.solver = solver;
  mjData* data = mj_makeData(model);
  const auto servo = [&] {
    for (int j = 0; j < model->njnt; ++j) {
      if (model->jnt_type[j] == mjJNT_BALL) continue;
      const int q = model->jnt_qposadr[j], v = model->jnt_dofadr[j];
      data->qfrc_applied[v] =
          data->qfrc_bias[v] - 200.0 * (data->qpos[q] - model->qpos0[q]) - 20.0 * data->qvel[v];
    }
  };
  using Clock = std::chrono::steady_clock;
  long steps = 0;
  const Clock::time_point start = Clock::now();
  double passed = 0.0;
  while (passed < seconds) {
    for (int i = 0; i < 240; ++i, ++steps) {
      servo();
      mj_step(model, data);
    }
    passed = std::chrono::duration<double>(Clock::now() - start).count();
  }
  bool finite = true;
  for (int i = 0; i < model->nq; ++i) finite = finite && std::abs(data->qpos[i]) < 1e3;
  std::printf(
      "{\"dofs\": %d, \"rows\": %d, \"contacts\": %d, \"steps\": %ld, \"seconds\": %.4f, "
      "\"stable\": %s}\n",
      model->nv, data->nefc, data->ncon, steps, passed, finite ? "true" : "false");
  mj_deleteData(data);
  mj_deleteModel(model);
}
