// MuJoCo's own world of a case: a chain of rigid segments on three springs each, soft contact with
// a cone of friction, and an arm whose joints go where they are told.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "discrepancy/scene_cases/scene_case.h"

namespace pedicel::scene_case {

namespace {

constexpr double dt = 2.5e-4;               // s
constexpr double segment = 0.01;            // m
constexpr int stretching = 4;               // segments to one that gives along the stem
constexpr double immovable = 1.0e4;         // kg m2 or kg, of driven joints
constexpr double string_stiffness = 150.0;  // N/m
constexpr double pi = 3.14159265358979323846;
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

/// The stem, as nested bodies: half a segment stands fast, and a joint lies in the middle of each
/// stretch of 10 mm that bends.
class Chain {
 public:
  Chain(const Setting& s, std::ostringstream& out) : s_(s), out_(out) {
    count_ = static_cast<int>(std::lround(s.height / segment));
    length_ = s.height / count_;
    const double factor = hidden_number(s, "youngs_modulus", "factor", 1.0);
    const double area = pi * s.radius * s.radius, second = 0.25 * area * s.radius * s.radius;
    bend_ = factor * s.modulus * second / length_;
    twist_ = bend_ / 1.35;  // GJ = 2 I E / (2 (1 + nu))
    stretch_ = factor * s.modulus * area / (length_ * stretching);
    const double density = s.density * hidden_number(s, "density", "factor", 1.0);
    mass_ = density * area * length_;
  }

  void write() {
    const double yaw = hidden_number(s_, "plant_pose", "yaw", 0.0);
    Vec3 root = s_.root;
    for (int a = 0; a < 3; ++a)
      root[a] += hidden_number(s_, "plant_pose", "offset", 0.0, static_cast<std::size_t>(a));
    out_ << "<body name='s0' pos='" << text(root) << "' euler='0 0 " << text(yaw) << "'>\n";
    piece(0.5 * length_);
    for (int i = 1; i <= count_; ++i) {
      const double end = i < count_ ? length_ : 0.5 * length_;
      out_ << "<body name='s" << i << "' pos='0 0 " << text(i == 1 ? 0.5 * length_ : length_)
           << "'>\n";
      if (i % stretching == stretching / 2) stretch(i);
      hinge("x", "1 0 0", i, bend_);
      hinge("y", "0 1 0", i, bend_);
      hinge("z", "0 0 1", i, twist_);
      piece(end);
      places(i);
    }
    for (int i = 0; i <= count_; ++i) out_ << "</body>\n";
  }

 private:
  void hinge(const char* axis, const char* vector, int i, double stiffness) {
    // Damping that acts at the step's end: (M + dt D) dv = dt (f - D v). As inertia it is in what
    // MuJoCo reckons contacts with, too; its own damping is not, and they would creep.
    out_ << "<joint name='" << axis << i << "' type='hinge' axis='" << vector << "' stiffness='"
         << text(stiffness) << "' armature='" << text(dt * damping_time(s_) * stiffness) << "'/>\n";
  }
  // A stem that sticks to a finger is held by its stretch, which is some 10 um/N.
  void stretch(int i) {
    out_ << "<joint name='a" << i << "' type='slide' axis='0 0 1' stiffness='" << text(stretch_)
         << "' armature='" << text(dt * damping_time(s_) * stretch_) << "'/>\n";
  }
  void piece(double length) {
    const double r2 = s_.radius * s_.radius, mass = mass_ * length / length_;
    const double across = mass * (0.25 * r2 + length * length / 12.0);
    out_ << "<inertial pos='0 0 " << text(0.5 * length) << "' mass='" << text(mass)
         << "' diaginertia='" << text(across) << " " << text(across) << " " << text(0.5 * mass * r2)
         << "'/>\n<geom type='capsule' class='plant' size='" << text(s_.radius)
         << "' fromto='0 0 0 0 0 " << text(length) << "'/>\n";
  }
  // Sites of markers whose place lies in this piece.
  void places(int i) {
    const double from = (i - 0.5) * length_, to = i < count_ ? from + length_ : s_.height + 1e-9;
    int m = 0;
    for (const auto& [curve, at] : markers_of(s_)) {
      const double place = at * s_.height;
      if (curve == "stem" && place > from && place <= to)
        out_ << "<site name='m" << m << "' pos='0 0 " << text(place - from) << "'/>\n";
      ++m;
    }
    const double tied = hidden_number(s_, "string", "at", -1.0) * s_.height;
    if (tied > from && tied <= to)
      out_ << "<site name='tied' pos='0 0 " << text(tied - from) << "'/>\n";
  }

  const Setting& s_;
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

void arm(const Setting& s, std::ostringstream& out) {
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
      << "' diaginertia='0.000002 0.00009 0.00009'/>\n<geom class='finger' type='capsule' size='"
      << text(finger_radius) << "' fromto='0 0 0 " << text(finger_length)
      << " 0 0'/>\n<site name='nail' pos='" << text(nail) << "'/>\n";
  if (is_hidden(s, "payload")) {
    Vec3 centre;
    for (int a = 0; a < 3; ++a)
      centre[a] = hidden_number(s, "payload", "centre", 0.0, static_cast<std::size_t>(a));
    out << "<body name='payload' pos='" << text(centre) << "'><inertial pos='0 0 0' mass='"
        << text(hidden_number(s, "payload", "mass", 0.0))
        << "' diaginertia='1e-9 1e-9 1e-9'/></body>\n";
  }
  out << "</body></body></body></body></body>\n";
}

std::string model_text(const Setting& s) {
  const double friction = hidden_number(s, "contact_friction", "coefficient", s.friction);
  std::ostringstream out;
  out << "<mujoco><compiler angle='radian' autolimits='true'/>\n<option timestep='" << text(dt)
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
  Chain(s, out).write();
  arm(s, out);
  out << "</worldbody>\n";
  out << "</mujoco>\n";
  return out.str();
}

Vec3 of(const mjtNum* v) {
  return {v[0], v[1], v[2]};
}

class World {
 public:
  World(const Setting& s, const Drive& drive) : s_(s), drive_(drive) {
    const std::string xml = model_text(s);
    auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "case.xml", static_cast<int>(xml.size()));
    std::copy(xml.begin(), xml.end(), static_cast<char*>(files->filedata[0]));
    char error[1000] = "";
    model_.reset(mj_loadXML("case.xml", files.get(), error, sizeof error));
    mj_deleteVFS(files.get());
    if (!model_) throw std::runtime_error(std::string("MuJoCo: ") + error + "\n" + xml);
    data_.reset(mj_makeData(model_.get()));
    for (const char* name : {"shoulder", "elbow", "lift"}) {
      const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, name);
      driven_.push_back(model_->jnt_dofadr[joint]);
      const int give = mj_name2id(model_.get(), mjOBJ_JOINT, (std::string(name) + "_give").c_str());
      giving_.push_back(give < 0 ? -1 : model_->jnt_dofadr[give]);
    }
    for (const char* name : {"hand", "finger", "payload"})
      if (const int body = mj_name2id(model_.get(), mjOBJ_BODY, name); body >= 0)
        beyond_.push_back(body);
    first_of_arm_ = mj_name2id(model_.get(), mjOBJ_BODY, "upper");
    hand_ = mj_name2id(model_.get(), mjOBJ_BODY, "hand");
    for (std::size_t m = 0; m < markers_of(s).size(); ++m)
      sites_.push_back(mj_name2id(model_.get(), mjOBJ_SITE, ("m" + std::to_string(m)).c_str()));
    sites_.push_back(mj_name2id(model_.get(), mjOBJ_SITE, "nail"));
    tied_ = mj_name2id(model_.get(), mjOBJ_SITE, "tied");
  }

  Run run() {
    Run out;
    out.dt = dt;
    lead(0.0);
    mj_forward(model_.get(), data_.get());
    settle();
    const int steps = static_cast<int>(std::lround(drive_.duration / dt));
    for (int k = 0; k <= steps; ++k) {
      lead(k * dt);
      push();
      mj_forward(model_.get(), data_.get());
      note(out, k > 0);
      note_outside(out.outside);
      mj_Euler(model_.get(), data_.get());
    }
    out.wrench.front() = out.wrench[1];
    return out;
  }

 private:
  // Where the links are told to be: readings and the encoders' zeros.
  Vec3 told(double t) const {
    Vec3 q = drive_.at(t);
    for (int j = 0; j < 3; ++j)
      q[j] += hidden_number(s_, "joint_offset", "offset", 0.0, static_cast<std::size_t>(j));
    return q;
  }

  void lead(double t) {
    const Vec3 now = told(t), before = told(t - dt);
    for (int j = 0; j < 3; ++j) {
      data_->qpos[driven_[static_cast<std::size_t>(j)]] = now[j];
      data_->qvel[driven_[static_cast<std::size_t>(j)]] = (now[j] - before[j]) / dt;
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
    const Vec3 a = (told(time_ + dt) - 2.0 * told(time_) + told(time_ - dt)) / (dt * dt);
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

  // N s and N m s about the world's origin, of the hand and all beyond it.
  void momentum() {
    linear_ = angular_ = Vec3::Zero();
    for (const int body : beyond_) {
      mjtNum v[6];
      mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, body, v, 0);
      const Vec3 w = of(v), com = of(data_->xipos + 3 * body);
      const Vec3 velocity = of(v + 3) + w.cross(com - of(data_->xpos + 3 * body));
      const Eigen::Matrix3d axes =
          Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->ximat + 9 * body);
      const Vec3 inertia = of(model_->body_inertia + 3 * body);
      linear_ += model_->body_mass[body] * velocity;
      angular_ += com.cross(model_->body_mass[body] * velocity) +
                  axes * inertia.asDiagonal() * axes.transpose() * w;
    }
  }

  void note(Run& out, bool moved) {
    out.joints.push_back(drive_.at(time_));
    std::vector<Vec3> markers;
    for (const int site : sites_) markers.push_back(of(data_->site_xpos + 3 * site));
    out.markers.push_back(std::move(markers));
    const Vec3 before = linear_, turning = angular_;
    momentum();
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    if (moved) force = -(linear_ - before) / dt, moment = -(angular_ - turning) / dt;
    for (const int body : beyond_) {
      const Vec3 weight = model_->body_mass[body] * Vec3(0, 0, -9.81);
      force += weight;
      moment += of(data_->xipos + 3 * body).cross(weight);
    }
    add_contacts(force, moment);
    const Eigen::Matrix3d axes =
        Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->xmat + 9 * hand_);
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << axes.transpose() * force,
        axes.transpose() * (moment - of(data_->xpos + 3 * hand_).cross(force));
    out.wrench.push_back(wrench);
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

  void add_contacts(Vec3& force, Vec3& moment) const {
    for (int c = 0; c < data_->ncon; ++c) {
      const mjContact& contact = data_->contact[c];
      const int first = model_->geom_bodyid[contact.geom1],
                second = model_->geom_bodyid[contact.geom2];
      const auto is_beyond = [&](int body) {
        return std::find(beyond_.begin(), beyond_.end(), body) != beyond_.end();
      };
      if (is_beyond(first) == is_beyond(second)) continue;
      mjtNum local[6];
      mj_contactForce(model_.get(), data_.get(), c, local);
      const Eigen::Matrix3d frame =
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(contact.frame);
      // The normal points from the first to the second; the force acts on the second.
      Vec3 f = frame.transpose() * of(local);
      if (is_beyond(first)) f = -f;
      force += f;
      moment += of(contact.pos).cross(f);
    }
  }

  const Setting& s_;
  const Drive& drive_;
  Model model_;
  Data data_;
  double time_ = 0.0;
  std::vector<int> driven_, giving_, beyond_, sites_;
  int hand_ = 0, first_of_arm_ = 0, tied_ = -1;
  Vec3 linear_ = Vec3::Zero(), angular_ = Vec3::Zero();
};

}  // namespace

Run simulate(const Setting& setting, const Drive& drive) {
  return World(setting, drive).run();
}

}  // namespace pedicel::scene_case
