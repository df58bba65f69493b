// MuJoCo's own world of a case: a chain of rigid segments on three springs each, soft contact with
// a cone of friction, and an arm whose joints go where they are told.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "tests/discrepancy/scene_cases/joint_way.h"
#include "tests/discrepancy/scene_cases/scene_case.h"

namespace pedicel::scene_case {

namespace {

constexpr double segment = 0.01;            // m, of the stem
constexpr double truss_segment = 0.005;     // m: between two clamps 6 segments are 3 % too stiff
constexpr int stretching = 4;               // segments to one that gives along the stem
constexpr double immovable = 1.0e4;         // kg m2 or kg, of driven joints
constexpr double string_stiffness = 150.0;  // N/m
// kg, of a soft pad: it is felt by what touches it alone; and s, its damping over its stiffness.
constexpr double pad_inertia = 0.02, pad_damping_time = 0.002;
constexpr double resting_speed = 1.0e-6;  // rad/s or m/s: a motor below it bears its load alone
constexpr double pi = 3.14159265358979323846;
// s. The contact of a stem that swings free and slides along the finger chatters: by 0.2 N with the
// longer step, by 0.05 N with half of it, and not with the shorter one.
double step_of(const Setting& s) {
  return s.truss ? 6.25e-5 : 2.5e-4;
}

double damping_time(const Setting& s) {
  return s.damping_time * hidden_number(s, "damping_time", "factor", 1.0);
}

struct Close {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using Model = std::unique_ptr<mjModel, Close>;
using Data = std::unique_ptr<mjData, Close>;

std::string text(double v) {
  std::ostringstream out;
  out.precision(15);
  out << v;
  return out.str();
}
std::string text(const Vec3& v) {
  return text(v.x()) + " " + text(v.y()) + " " + text(v.z());
}
std::string text(const Eigen::Quaterniond& q) {
  return text(q.w()) + " " + text(q.x()) + " " + text(q.y()) + " " + text(q.z());
}

/// How the finger holds the fruit once it is off: the pose of the fruit's body in its frame.
struct Held {
  Vec3 place = Vec3::Zero();  // m
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
};

/// The fruit's body: half a segment of its stalk, along z, and a ball at its end.
class Fruit {
 public:
  explicit Fruit(const Setting& s) : radius_(s.truss->fruit_radius) {
    const Truss& truss = *s.truss;
    stub_ = 0.5 * truss.length / std::round(truss.length / truss_segment);
    const double r2 = truss.radius * truss.radius, f2 = radius_ * radius_;
    const double own = s.density * hidden_number(s, "density", "factor", 1.0) * pi * r2 * stub_;
    const double ball = 4.0 / 3.0 * pi * f2 * radius_ * truss.fruit_density *
                        hidden_number(s, "fruit_mass", "factor", 1.0);
    mass_ = own + ball;
    centre_ = (own * 0.5 * stub_ + ball * stub_) / mass_;
    along_ = 0.5 * own * r2 + 0.4 * ball * f2;
    const double near = centre_ - 0.5 * stub_, far = stub_ - centre_;
    across_ =
        own * (0.25 * r2 + stub_ * stub_ / 12.0 + near * near) + ball * (0.4 * f2 + far * far);
  }
  /// `kind`: attributes of the ball.
  std::string text_of(const std::string& kind) const {
    return "<inertial pos='0 0 " + text(centre_) + "' mass='" + text(mass_) + "' diaginertia='" +
           text(across_) + " " + text(across_) + " " + text(along_) + "'/>\n<geom type='sphere' " +
           kind + " size='" + text(radius_) + "' pos='0 0 " + text(stub_) + "'/>\n";
  }

 private:
  double radius_, stub_ = 0.0, mass_ = 0.0, centre_ = 0.0, along_ = 0.0, across_ = 0.0;
};

/// A curve of the plant, as nested bodies: half a segment stands fast, and a joint lies in the
/// middle of each stretch that bends. The truss begins in the stem.
class Chain {
 public:
  /// `held`: the fruit is off.
  static void write_stem(const Setting& s, const Held* held, std::ostringstream& out) {
    const double yaw = hidden_number(s, "plant_pose", "yaw", 0.0);
    Vec3 root = s.root;
    for (int a = 0; a < 3; ++a)
      root[a] += hidden_number(s, "plant_pose", "offset", 0.0, static_cast<std::size_t>(a));
    Chain(s, "stem", "", s.height, s.radius, held, out)
        .write("pos='" + text(root) + "' euler='0 0 " + text(yaw) + "'");
  }

 private:
  Chain(const Setting& s, const std::string& curve, const std::string& letter, double length,
        double radius, const Held* held, std::ostringstream& out)
      : s_(s),
        curve_(curve),
        letter_(letter),
        whole_(length),
        radius_(radius),
        held_(held),
        out_(out) {
    count_ = static_cast<int>(std::lround(whole_ / (is_truss() ? truss_segment : segment)));
    length_ = whole_ / count_;
    const double factor = hidden_number(s, "youngs_modulus", "factor", 1.0);
    const double area = pi * radius * radius, second = 0.25 * area * radius * radius;
    bend_ = factor * s.modulus * second / length_;
    twist_ = bend_ / 1.35;  // GJ = 2 I E / (2 (1 + nu))
    stretch_ = factor * s.modulus * area / (length_ * stretching);
    const double density = s.density * hidden_number(s, "density", "factor", 1.0);
    mass_ = density * area * length_;
  }

  bool is_truss() const { return curve_ == "truss"; }

  void write(const std::string& pose) {
    out_ << "<body name='" << letter_ << "s0' " << pose << ">\n";
    if (!is_truss()) root();
    piece(0.5 * length_);
    int open = 1;
    for (int i = 1; i <= count_; ++i) {
      const bool fruit = is_truss() && i == count_;
      if (fruit && held_) break;
      const double end = i < count_ ? length_ : 0.5 * length_;
      const std::string name = fruit ? "fruit" : letter_ + "s" + std::to_string(i);
      out_ << "<body name='" << name << "' pos='0 0 " << text(i == 1 ? 0.5 * length_ : length_)
           << "'>\n";
      ++open;
      if (i % stretching == stretching / 2) stretch(i);
      const double weak = weakness(i);
      hinge("x", "1 0 0", i, bend_ / weak);
      hinge("y", "0 1 0", i, bend_ / weak);
      hinge("z", "0 0 1", i, twist_ / weak);
      if (fruit)
        out_ << Fruit(s_).text_of("class='plant'");
      else
        piece(end);
      places(i);
      if (!is_truss() && s_.truss) branch(i);
    }
    for (; open > 0; --open) out_ << "</body>\n";
  }

  // The truss begins in the middle of the stem's piece at its foot.
  void branch(int i) {
    const Truss& truss = *s_.truss;
    if (i != static_cast<int>(std::lround(truss.from / length_))) return;
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Vec3(0, 0, 1), truss.direction);
    Chain(s_, "truss", "t", truss.length, truss.radius, held_, out_)
        .write("pos='0 0 " + text(truss.from - (i - 0.5) * length_) + "' quat='" + text(turn) +
               "'");
  }

  // A soft root: a spring about both bending axes between ground and stem. It is damped as the stem
  // is, and so in series with it gives as one softer joint does.
  void root() {
    if (!is_hidden(s_, "base_compliance")) return;
    const double k = hidden_number(s_, "base_compliance", "stiffness", 0.0);
    hinge("x", "1 0 0", 0, k);
    hinge("y", "0 1 0", 0, k);
  }

  // By how much more the joint gives that stands for a stretch of one segment: its share of a weak
  // stretch, in which EI and GJ are `factor` times as large.
  double weakness(int i) const {
    if (is_truss() || !is_hidden(s_, "weak_segment")) return 1.0;
    const double centre = hidden_number(s_, "weak_segment", "at", 0.0) * whole_;
    const double half = 0.5 * hidden_number(s_, "weak_segment", "length", 0.0);
    const double shared =
        std::min(i * length_, centre + half) - std::max((i - 1) * length_, centre - half);
    const double share = std::clamp(shared / length_, 0.0, 1.0);
    return 1.0 - share + share / hidden_number(s_, "weak_segment", "factor", 1.0);
  }

  void hinge(const char* axis, const char* vector, int i, double stiffness) {
    // Damping that acts at the step's end: (M + dt D) dv = dt (f - D v). As inertia it is in what
    // MuJoCo reckons contacts with, too; its own damping is not, and they would creep.
    out_ << "<joint name='" << letter_ << axis << i << "' type='hinge' axis='" << vector
         << "' stiffness='" << text(stiffness) << "' armature='"
         << text(step_of(s_) * damping_time(s_) * stiffness) << "'/>\n";
  }
  // A stem that sticks to a finger is held by its stretch, which is some 10 um/N.
  void stretch(int i) {
    out_ << "<joint name='" << letter_ << "a" << i << "' type='slide' axis='0 0 1' stiffness='"
         << text(stretch_) << "' armature='" << text(step_of(s_) * damping_time(s_) * stretch_)
         << "'/>\n";
  }
  void piece(double length) {
    const double r2 = radius_ * radius_, mass = mass_ * length / length_;
    const double across = mass * (0.25 * r2 + length * length / 12.0);
    out_ << "<inertial pos='0 0 " << text(0.5 * length) << "' mass='" << text(mass)
         << "' diaginertia='" << text(across) << " " << text(across) << " " << text(0.5 * mass * r2)
         << "'/>\n<geom type='capsule' class='plant' size='" << text(radius_)
         << "' fromto='0 0 0 0 0 " << text(length) << "'/>\n";
  }
  // Sites of what is told of this piece, and a mass that its file lacks.
  void places(int i) {
    const double from = (i - 0.5) * length_, to = i < count_ ? from + length_ : whole_ + 1e-9;
    const auto sites = [&](const std::vector<Place>& all, const char* letter) {
      for (std::size_t m = 0; m < all.size(); ++m) {
        const double place = all[m].second * whole_;
        if (all[m].first == curve_ && place > from && place <= to)
          out_ << "<site name='" << letter << m << "' pos='0 0 " << text(place - from) << "'/>\n";
      }
    };
    sites(markers_of(s_), "m");
    sites(points_of(s_), "p");
    const double heavy = hidden_number(s_, "extra_mass", "at", -1.0) * whole_;
    if (!is_truss() && heavy > from && heavy <= to)
      out_ << "<body name='extra' pos='0 0 " << text(heavy - from)
           << "'><inertial pos='0 0 0' mass='" << text(hidden_number(s_, "extra_mass", "mass", 0.0))
           << "' diaginertia='1e-9 1e-9 1e-9'/></body>\n";
    const double tied = hidden_number(s_, "string", "at", -1.0) * whole_;
    if (!is_truss() && tied > from && tied <= to)
      out_ << "<site name='tied' pos='0 0 " << text(tied - from) << "'/>\n";
  }

  const Setting& s_;
  std::string curve_, letter_;
  double whole_, radius_;
  const Held* held_;
  std::ostringstream& out_;
  int count_ = 0;
  double length_ = 0.0, bend_ = 0.0, twist_ = 0.0, stretch_ = 0.0, mass_ = 0.0;
};

// A joint of the arm: driven, and beyond it a spring where joints give way.
void arm_joint(std::ostringstream& out, const char* name, bool slides, double stiffness) {
  const char* kind = slides ? "slide" : "hinge";
  out << "<joint name='" << name << "' type='" << kind << "' axis='0 0 1' armature='" << immovable
      << "'/>\n";
  if (stiffness > 0.0)
    out << "<joint name='" << name << "_give' type='" << kind << "' axis='0 0 1' stiffness='"
        << text(stiffness) << "' damping='" << text(0.01 * stiffness) << "'/>\n";
}

// What touches. A soft one gives way by force over stiffness, whichever way it is pushed.
void fingertip(const Setting& s, std::ostringstream& out) {
  const std::string shape = "type='capsule' size='" + text(finger_radius) + "' fromto='0 0 0 " +
                            text(finger_length) + " 0 0'/>\n";
  if (!is_hidden(s, "contact_compliance")) {
    out << "<geom class='finger' " << shape;
    return;
  }
  const double k = hidden_number(s, "contact_compliance", "stiffness", 0.0);
  out << "<body name='pad'><inertial pos='0 0 0' mass='1e-6' diaginertia='1e-9 1e-9 1e-9'/>\n";
  for (const char* axis : {"1 0 0", "0 1 0", "0 0 1"})
    out << "<joint name='pad " << axis << "' type='slide' axis='" << axis << "' stiffness='"
        << text(k) << "' damping='" << text(pad_damping_time * k) << "' armature='"
        << text(pad_inertia) << "'/>\n";
  out << "<geom class='finger' " << shape << "</body>\n";
}

void arm(const Setting& s, const Held* held, std::ostringstream& out) {
  const double k = hidden_number(s, "reaction", "joint_stiffness", 0.0);
  Vec3 offset = Vec3::Zero(), turn = Vec3::Zero();
  for (int a = 0; a < 3; ++a) {
    offset[a] = hidden_number(s, "tool_pose", "offset", 0.0, static_cast<std::size_t>(a));
    turn[a] = hidden_number(s, "tool_pose", "rotation", 0.0, static_cast<std::size_t>(a));
  }
  const double angle = turn.norm();
  const Vec3 axis = angle > 0.0 ? Vec3(turn / angle) : Vec3(0, 0, 1);
  out << "<body name='upper' pos='0 0 " << text(shoulder_height) << "'>\n";
  arm_joint(out, "shoulder", false, k);
  out << "<inertial pos='0.125 0 0' mass='0.8' diaginertia='0.0004 0.0045 0.0045'/>\n"
      << "<body name='fore' pos='" << text(upper_length) << " 0 0'>\n";
  arm_joint(out, "elbow", false, k);
  out << "<inertial pos='0.1 0 0' mass='0.5' diaginertia='0.0002 0.0018 0.0018'/>\n"
      << "<body name='lift' pos='" << text(fore_length - 0.05) << " 0 0'>\n";
  arm_joint(out, "lift", true, k);
  out << "<inertial pos='0 0 0' mass='0.2' diaginertia='0.0001 0.0001 0.0001'/>\n"
      << "<body name='hand' pos='0.02 0 0'>\n<inertial pos='0.015 0 0' mass='" << text(hand_mass)
      << "' diaginertia='0.00008 0.00008 0.00008'/>\n<body name='finger' pos='"
      << text(Vec3(0.03, 0, 0) + offset) << "' axisangle='" << text(axis) << " " << text(angle)
      << "'>\n<inertial pos='" << text(0.5 * finger_length) << " 0 0' mass='" << text(finger_mass)
      << "' diaginertia='0.000002 0.00009 0.00009'/>\n";
  fingertip(s, out);
  out << "<site name='nail' pos='" << text(nail) << "'/>\n";
  if (is_hidden(s, "payload")) {
    Vec3 centre;
    for (int a = 0; a < 3; ++a)
      centre[a] = hidden_number(s, "payload", "centre", 0.0, static_cast<std::size_t>(a));
    out << "<body name='payload' pos='" << text(centre) << "'><inertial pos='0 0 0' mass='"
        << text(hidden_number(s, "payload", "mass", 0.0))
        << "' diaginertia='1e-9 1e-9 1e-9'/></body>\n";
  }
  // It has come off, is carried, and touches nothing any more.
  if (held)
    out << "<body name='fruit' pos='" << text(held->place) << "' quat='" << text(held->turn)
        << "'>\n"
        << Fruit(s).text_of("contype='0' conaffinity='0'") << "</body>\n";
  out << "</body></body></body></body></body>\n";
}

/// `held`: the fruit is off, and the finger carries it.
std::string model_text(const Setting& s, const Held* held = nullptr) {
  const double friction = hidden_number(s, "contact_friction", "coefficient", s.friction);
  std::ostringstream out;
  out << "<mujoco><compiler angle='radian' autolimits='true'/>\n<option timestep='"
      << text(step_of(s))
      << "' cone='elliptic' impratio='100' integrator='Euler' solver='PGS' iterations='200' "
         "tolerance='1e-9' noslip_iterations='20'/>\n"
      << "<size nconmax='200' njmax='2000'/>\n"
      << "<default><geom condim='3' friction='" << text(friction)
      << " 0.005 0.0001' solref='0.001 1' solimp='0.3 0.3 0.001'/>\n"
      << "<default class='plant'><geom contype='1' conaffinity='2'/></default>\n"
      << "<default class='finger'><geom contype='2' conaffinity='1'/></default></default>\n"
      << "<worldbody>\n";
  if (is_hidden(s, "post")) {
    Vec3 place;
    for (int a = 0; a < 3; ++a)
      place[a] = hidden_number(s, "post", "position", 0.0, static_cast<std::size_t>(a));
    out << "<geom class='finger' type='capsule' size='0.003' fromto='"
        << text(place - Vec3(0.03, 0, 0)) << " " << text(place + Vec3(0.03, 0, 0)) << "'/>\n";
  }
  Chain::write_stem(s, held, out);
  arm(s, held, out);
  out << "</worldbody>\n";
  // Of hardly any softness: who holds it holds it rigidly.
  if (s.truss && !held)
    out << "<equality><weld name='grasp' body1='finger' body2='fruit' active='false' "
           "solref='0.001 1' solimp='0.999 0.999 0.001'/></equality>\n";
  out << "</mujoco>\n";
  return out.str();
}

Vec3 of(const mjtNum* v) {
  return {v[0], v[1], v[2]};
}

Eigen::Quaterniond turn_of(const mjtNum* q) {
  return {q[0], q[1], q[2], q[3]};
}

Model compiled(const std::string& xml) {
  auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "case.xml", static_cast<int>(xml.size()));
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files->filedata[0]));
  char error[1000] = "";
  Model model(mj_loadXML("case.xml", files.get(), error, sizeof error));
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error + "\n" + xml);
  return model;
}

/// Where the plant's springs are at rest, by the joint's name: it stands as drawn under its own
/// weight, by what its file says.
std::map<std::string, double> rest_of(Setting s) {
  std::map<std::string, double> rest;
  if (!s.truss) return rest;
  s.hidden.clear();
  const Model model = compiled(model_text(s));
  const Data data(mj_makeData(model.get()));
  mj_forward(model.get(), data.get());
  for (int j = 0; j < model->njnt; ++j)
    if (model->jnt_stiffness[j] > 0.0)
      rest[mj_id2name(model.get(), mjOBJ_JOINT, j)] =
          data->qfrc_bias[model->jnt_dofadr[j]] / model->jnt_stiffness[j];
  return rest;
}

/// A link and all beyond it, with N s and N m s about the world's origin at the last step.
struct Beyond {
  std::vector<int> bodies;
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

class World {
 public:
  World(const Setting& s, const Drive& drive)
      : s_(s), drive_(drive), dt_(step_of(s)), way_(s, drive, dt_), rest_(rest_of(s)) {
    load(nullptr);
  }

  Run run() {
    Run out;
    out.dt = dt_;
    lead(0.0);
    mj_forward(model_.get(), data_.get());
    settle();
    const int steps = static_cast<int>(std::lround(drive_.duration / dt_));
    for (int k = 0; k <= steps; ++k) {
      lead(k * dt_);
      if (k * dt_ >= drive_.grasp && !is_held_) take_hold();
      push();
      mj_forward(model_.get(), data_.get());
      note(out, k > 0);
      note_outside(out.outside);
      if (is_held_ && !out.came_off && stalk_load() > strength()) {
        out.came_off = time_;
        come_off();
      }
      mj_Euler(model_.get(), data_.get());
    }
    out.wrench.front() = out.wrench[1];
    if (s_.torques) out.efforts.front() = out.efforts[1];
    return out;
  }

 private:
  void load(const Held* held) {
    model_ = compiled(model_text(s_, held));
    data_.reset(mj_makeData(model_.get()));
    const auto id = [&](int kind, const std::string& name) {
      return mj_name2id(model_.get(), kind, name.c_str());
    };
    driven_.clear(), giving_.clear(), sites_.clear(), points_.clear();
    for (const std::string name : {"shoulder", "elbow", "lift"}) {
      motors_[driven_.size()] = id(mjOBJ_JOINT, name);
      driven_.push_back(model_->jnt_dofadr[id(mjOBJ_JOINT, name)]);
      const int give = id(mjOBJ_JOINT, name + "_give");
      giving_.push_back(give < 0 ? -1 : model_->jnt_dofadr[give]);
    }
    std::vector<int> links;
    for (const std::string name : {"hand", "finger", "pad", "payload"})
      if (const int body = id(mjOBJ_BODY, name); body >= 0) links.push_back(body);
    finger_ = id(mjOBJ_BODY, "finger");
    fruit_ = id(mjOBJ_BODY, "fruit");
    if (held) links.push_back(fruit_);
    beyond_hand_ = {links};
    beyond_motor_ = {};
    for (std::size_t j = 3; j-- > 0 && s_.torques;) {
      links.push_back(model_->jnt_bodyid[motors_[j]]);
      beyond_motor_[j] = {links};
    }
    first_of_arm_ = id(mjOBJ_BODY, "upper");
    hand_ = id(mjOBJ_BODY, "hand");
    for (std::size_t m = 0; m < markers_of(s_).size(); ++m)
      sites_.push_back(id(mjOBJ_SITE, "m" + std::to_string(m)));
    sites_.push_back(id(mjOBJ_SITE, "nail"));
    for (std::size_t p = 0; p < points_of(s_).size(); ++p)
      points_.push_back(id(mjOBJ_SITE, "p" + std::to_string(p)));
    tied_ = id(mjOBJ_SITE, "tied");
    soften();
    for (int j = 0; j < model_->njnt; ++j)
      if (const auto known = rest_.find(mj_id2name(model_.get(), mjOBJ_JOINT, j));
          known != rest_.end() && model_->jnt_bodyid[j] < first_of_arm_)
        model_->qpos_spring[model_->jnt_qposadr[j]] = known->second;
  }

  // The contact before the pad gives way by (1 - d) A t^2 for each newton at rest, with MuJoCo's
  // impedance d, time t and inverse masses A: both together shall have the stiffness that is
  // hidden.
  void soften() {
    const double k = hidden_number(s_, "contact_compliance", "stiffness", 0.0);
    const int pad = mj_name2id(model_.get(), mjOBJ_BODY, "pad");
    if (pad < 0) return;
    const double length = s_.height / std::lround(s_.height / segment);
    const std::string piece = "s" + std::to_string(std::lround(0.55 * s_.height / length));
    const int pushed = mj_name2id(model_.get(), mjOBJ_BODY, piece.c_str());
    const double inverse_mass =
        model_->body_invweight0[2 * pad] + model_->body_invweight0[2 * pushed];
    const double own = (1.0 - 0.3) * inverse_mass * 1.0e-6;  // m/N
    for (int j = 0; j < model_->njnt; ++j)
      if (model_->jnt_bodyid[j] == pad) model_->jnt_stiffness[j] = 1.0 / (1.0 / k - own);
  }

  // The finger's and the fruit's frames stay to each other as they are now.
  void take_hold() {
    mj_kinematics(model_.get(), data_.get());
    const Vec3 place = of(data_->xpos + 3 * fruit_);
    const Eigen::Quaterniond finger = turn_of(data_->xquat + 4 * finger_),
                             fruit = turn_of(data_->xquat + 4 * fruit_);
    const Vec3 in_finger = finger.conjugate() * (place - of(data_->xpos + 3 * finger_));
    const Eigen::Quaterniond turn = finger.conjugate() * fruit;
    // The place in the fruit's frame, in the finger's, the turn, and how much moments weigh.
    const mjtNum pose[mjNEQDATA] = {0.0,           0.0,           0.0,      in_finger.x(),
                                    in_finger.y(), in_finger.z(), turn.w(), turn.x(),
                                    turn.y(),      turn.z(),      1.0};
    std::copy(pose, pose + mjNEQDATA, model_->eq_data);
    model_->eq_active[0] = 1;
    is_held_ = true;
  }

  double strength() const {
    return s_.truss->strength * hidden_number(s_, "detachment_threshold", "factor", 1.0);
  }

  // N, N m about the fruit's frame, W: of the fruit on the finger that holds it.
  std::pair<Vec3, Vec3> hold() const {
    if (!is_held_ || is_off_ || data_->ne != 6) return {Vec3::Zero(), Vec3::Zero()};
    return {of(data_->efc_force),
            0.5 * (turn_of(data_->xquat + 4 * fruit_) * of(data_->efc_force + 3))};
  }

  // N, in the joint next to the fruit: what the fruit's motion leaves of weight, hold and touch.
  double stalk_load() const {
    const Vec3 weight = model_->body_mass[fruit_] * Vec3(0, 0, -9.81);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    add_contacts({fruit_}, force, moment);
    return (model_->body_mass[fruit_] * fruit_acceleration_ - weight - force + hold().first).norm();
  }

  // From now on the finger carries the fruit as its own.
  void come_off() {
    const Eigen::Quaterniond finger = turn_of(data_->xquat + 4 * finger_);
    const Held held{
        finger.conjugate() * (of(data_->xpos + 3 * fruit_) - of(data_->xpos + 3 * finger_)),
        finger.conjugate() * turn_of(data_->xquat + 4 * fruit_)};
    const Model model = std::move(model_);
    const Data data = std::move(data_);
    load(&held);
    for (int j = 0; j < model_->njnt; ++j) {
      const int old =
          mj_name2id(model.get(), mjOBJ_JOINT, mj_id2name(model_.get(), mjOBJ_JOINT, j));
      data_->qpos[model_->jnt_qposadr[j]] = data->qpos[model->jnt_qposadr[old]];
      data_->qvel[model_->jnt_dofadr[j]] = data->qvel[model->jnt_dofadr[old]];
    }
    is_off_ = true;
    lead(time_);
    mj_forward(model_.get(), data_.get());
    push();
    mj_forward(model_.get(), data_.get());
    momentum(beyond_hand_);
    for (Beyond& beyond : beyond_motor_) momentum(beyond);
  }

  // Where the links are: readings and the encoders' zeros.
  Vec3 told(double t) const {
    Vec3 q = way_.at(t);
    for (int j = 0; j < 3; ++j)
      q[j] += hidden_number(s_, "joint_offset", "offset", 0.0, static_cast<std::size_t>(j));
    return q;
  }

  void lead(double t) {
    const Vec3 now = told(t), before = told(t - dt_);
    for (int j = 0; j < 3; ++j) {
      data_->qpos[driven_[static_cast<std::size_t>(j)]] = now[j];
      data_->qvel[driven_[static_cast<std::size_t>(j)]] = (now[j] - before[j]) / dt_;
    }
    data_->time = t;
    time_ = t;
  }

  // What acts on joints beside springs: the stem's damping, and on the arm what its motors do. The
  // springs of joints that give way do not feel weight and inertia of the motion.
  void push() {
    for (int joint = 0; joint < model_->njnt; ++joint)
      if (model_->jnt_bodyid[joint] < first_of_arm_) {
        const int v = model_->jnt_dofadr[joint];
        data_->qfrc_applied[v] = -damping_time(s_) * model_->jnt_stiffness[joint] * data_->qvel[v];
      }
    pull();
    const Vec3 a = (told(time_ + dt_) - 2.0 * told(time_) + told(time_ - dt_)) / (dt_ * dt_);
    std::vector<mjtNum> mass(static_cast<std::size_t>(model_->nv * model_->nv));
    if (giving_.front() >= 0) mj_fullM(model_.get(), mass.data(), data_->qM);
    for (std::size_t j = 0; j < 3; ++j) {
      const int driven = driven_[j];
      data_->qfrc_applied[driven] = data_->qfrc_bias[driven] + immovable * a[static_cast<long>(j)];
      if (giving_[j] < 0) continue;
      double effort = data_->qfrc_bias[giving_[j]];
      for (std::size_t i = 0; i < 3; ++i)
        effort += mass[static_cast<std::size_t>(giving_[j] * model_->nv + driven_[i])] *
                  a[static_cast<long>(i)];
      data_->qfrc_applied[giving_[j]] = effort;
    }
  }

  // N, of a string between a place of the stem and a fixed one: it pulls where it is taut.
  Vec3 tension() const {
    if (tied_ < 0) return Vec3::Zero();
    Vec3 anchor;
    for (int a = 0; a < 3; ++a)
      anchor[a] = hidden_number(s_, "string", "anchor", 0.0, static_cast<std::size_t>(a));
    const Vec3 way = anchor - of(data_->site_xpos + 3 * tied_);
    const double beyond = way.norm() - hidden_number(s_, "string", "length", 0.0);
    return beyond > 0.0 ? Vec3(string_stiffness * beyond * way.normalized()) : Vec3(0, 0, 0);
  }
  // Sites are where the step before left them: a wire of 150 N/m does not mind.
  void pull() {
    const Vec3 force = tension();
    if (force.isZero(0.0)) return;
    const mjtNum none[3] = {0, 0, 0};
    mj_applyFT(model_.get(), data_.get(), force.data(), none, data_->site_xpos + 3 * tied_,
               model_->site_bodyid[tied_], data_->qfrc_applied);
  }

  // Upright stems stand as they are drawn; a twentieth of a second takes what is left.
  void settle() {
    for (int k = 0; k < 200; ++k) {
      push();
      mj_step(model_.get(), data_.get());
      for (int v = 0; v < model_->nv; ++v) data_->qvel[v] *= 0.95;
      lead(0.0);
    }
    for (int v = 0; v < model_->nv; ++v) data_->qvel[v] = 0.0;
    mj_forward(model_.get(), data_.get());
  }

  void momentum(Beyond& beyond) const {
    beyond.linear = beyond.angular = Vec3::Zero();
    for (const int body : beyond.bodies) {
      mjtNum v[6];
      mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, body, v, 0);
      // MuJoCo's velocity of a body is that of its centre of mass.
      const Vec3 w = of(v), com = of(data_->xipos + 3 * body), velocity = of(v + 3);
      const Eigen::Matrix3d axes =
          Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->ximat + 9 * body);
      const Vec3 inertia = of(model_->body_inertia + 3 * body);
      beyond.linear += model_->body_mass[body] * velocity;
      beyond.angular += com.cross(model_->body_mass[body] * velocity) +
                        axes * inertia.asDiagonal() * axes.transpose() * w;
    }
  }

  // What has come off has no place any more.
  std::vector<Vec3> places(const std::vector<int>& sites) const {
    std::vector<Vec3> out;
    for (const int site : sites)
      out.push_back(site < 0 ? Vec3::Constant(std::nan("")) : of(data_->site_xpos + 3 * site));
    return out;
  }

  void note_fruit(bool moved) {
    if (fruit_ < 0) return;
    mjtNum v[6];
    mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, fruit_, v, 0);
    const Vec3 velocity = of(v + 3);
    fruit_acceleration_ = moved ? Vec3((velocity - fruit_velocity_) / dt_) : Vec3(0, 0, 0);
    fruit_velocity_ = velocity;
  }

  void note(Run& out, bool moved) {
    out.joints.push_back(way_.at(time_));
    out.markers.push_back(places(sites_));
    out.points.push_back(places(points_));
    out.pushed.push_back(pushed());
    note_fruit(moved);
    const auto [force, moment] = exerted(beyond_hand_, moved);
    const Eigen::Matrix3d axes =
        Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->xmat + 9 * hand_);
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << axes.transpose() * force,
        axes.transpose() * (moment - of(data_->xpos + 3 * hand_).cross(force));
    out.wrench.push_back(wrench);
    if (s_.torques) out.efforts.push_back(efforts(moved));
  }

  // N, N m about the world's origin: of links on what carries them, weight, inertia and all that
  // touches or holds them.
  std::pair<Vec3, Vec3> exerted(Beyond& beyond, bool moved) const {
    const Vec3 before = beyond.linear, turning = beyond.angular;
    momentum(beyond);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    if (moved) force = -(beyond.linear - before) / dt_, moment = -(beyond.angular - turning) / dt_;
    for (const int body : beyond.bodies) {
      const Vec3 weight = model_->body_mass[body] * Vec3(0, 0, -9.81);
      force += weight;
      moment += of(data_->xipos + 3 * body).cross(weight);
    }
    add_contacts(beyond.bodies, force, moment);
    const auto [held, turned] = hold();
    force += held;
    moment += of(data_->xpos + 3 * std::max(0, fruit_)).cross(held) + turned;
    return {force, moment};
  }

  // What motors bear of all beyond them, and their joint's friction: Coulomb's, and none at rest.
  Vec3 efforts(bool moved) {
    const Vec3 speed = (way_.at(time_ + dt_) - way_.at(time_ - dt_)) / (2.0 * dt_);
    Vec3 all;
    for (std::size_t j = 0; j < 3; ++j) {
      const auto [force, moment] = exerted(beyond_motor_[j], moved);
      const int joint = motors_[j];
      const Vec3 axis = of(data_->xaxis + 3 * joint), place = of(data_->xanchor + 3 * joint);
      const bool slides = model_->jnt_type[joint] == mjJNT_SLIDE;
      const double v = speed[static_cast<long>(j)];
      const double along = axis.dot(slides ? force : Vec3(moment - place.cross(force)));
      const double dry = hidden_number(s_, "joint_friction", "coulomb", 0.0, j);
      all[static_cast<long>(j)] = -along +
                                  hidden_number(s_, "joint_friction", "viscous", 0.0, j) * v +
                                  (std::abs(v) < resting_speed ? 0.0 : std::copysign(dry, v));
    }
    return all;
  }

  // m, along the stem, of the middle of all pushes of the arm; NaN without any.
  double pushed() const {
    double sum = 0.0, all = 0.0;
    for (int c = 0; c < data_->ncon; ++c) {
      const mjContact& contact = data_->contact[c];
      int body = model_->geom_bodyid[contact.geom1], other = model_->geom_bodyid[contact.geom2];
      if (body > other) std::swap(body, other);
      // The arm's bodies come after the plant's, whose names count the stem's pieces.
      const std::string name = mj_id2name(model_.get(), mjOBJ_BODY, body);
      if (other < first_of_arm_ || !name.starts_with("s")) continue;
      const double length = s_.height / std::lround(s_.height / segment);
      const int piece = std::stoi(name.substr(1));
      const Eigen::Matrix3d axes =
          Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->xmat + 9 * body);
      const double along = axes.col(2).dot(of(contact.pos) - of(data_->xpos + 3 * body));
      mjtNum local[6];
      mj_contactForce(model_.get(), data_.get(), c, local);
      sum += local[0] * (along + std::max(0.0, (piece - 0.5) * length));
      all += local[0];
    }
    return all > 0.0 ? sum / all : std::nan("");
  }

  // When something from outside first acts on the stem with more than a trifle.
  void note_outside(Outside& out) const {
    if (out.acts) return;
    const auto take = [&](double force, const mjtNum* place) {
      if (force < 0.02) return;  // N
      out.acts = true;
      out.from = time_;
      out.place = of(place);
    };
    if (tied_ >= 0) take(tension().norm(), data_->site_xpos + 3 * tied_);
    for (int c = 0; c < data_->ncon; ++c) {
      const mjContact& contact = data_->contact[c];
      if (model_->geom_bodyid[contact.geom1] != 0 && model_->geom_bodyid[contact.geom2] != 0)
        continue;  // of the finger: only a post stands in the world
      mjtNum local[6];
      mj_contactForce(model_.get(), data_.get(), c, local);
      take(of(local).norm(), contact.pos);
    }
  }

  // Of all else on some bodies; moments about the world's origin.
  void add_contacts(const std::vector<int>& bodies, Vec3& force, Vec3& moment) const {
    for (int c = 0; c < data_->ncon; ++c) {
      const mjContact& contact = data_->contact[c];
      const int first = model_->geom_bodyid[contact.geom1],
                second = model_->geom_bodyid[contact.geom2];
      const auto is_one = [&](int body) {
        return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
      };
      if (is_one(first) == is_one(second)) continue;
      mjtNum local[6];
      mj_contactForce(model_.get(), data_.get(), c, local);
      const Eigen::Matrix3d frame =
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(contact.frame);
      // The normal points from the first to the second; the force acts on the second.
      Vec3 f = frame.transpose() * of(local);
      if (is_one(first)) f = -f;
      force += f;
      moment += of(contact.pos).cross(f);
    }
  }

  const Setting& s_;
  const Drive& drive_;
  const double dt_;  // s
  JointWay way_;
  Model model_;
  Data data_;
  double time_ = 0.0;
  std::map<std::string, double> rest_;  // rad or m, by joint
  std::vector<int> driven_, giving_, sites_, points_;
  std::array<int, 3> motors_{};  // joints
  int hand_ = 0, finger_ = 0, fruit_ = -1, first_of_arm_ = 0, tied_ = -1;
  bool is_held_ = false, is_off_ = false;
  Beyond beyond_hand_;
  std::array<Beyond, 3> beyond_motor_;
  Vec3 fruit_velocity_ = Vec3::Zero(), fruit_acceleration_ = Vec3::Zero();
};

}  // namespace

Run simulate(const Setting& setting, const Drive& drive) {
  return World(setting, drive).run();
}

}  // namespace pedicel::scene_case
