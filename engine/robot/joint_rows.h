#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include <vector>

namespace pedicel::robot {

/// All joint-space constraints of one robot, solved by Bullet together with its contacts. Each row
/// drives one velocity, coefficient * qd[link] + coefficient_b * qd[link_b], to a target with a
/// bounded impulse. Bullet's own motor, limit and gear can only take symmetric bounds and no
/// softness, so that a motor with feed-forward, Coulomb friction and implicit damping cannot be
/// said with them.
class JointRows : public btMultiBodyConstraint {
 public:
  struct Row {
    int link = 0;  ///< Bullet link whose joint is driven
    double coefficient = 1.0;
    int link_b = -1;  ///< second joint, -1 for none
    double coefficient_b = 0.0;
    bool active = false;
    double target = 0.0;  ///< rad/s or m/s
    double lower = 0.0;   ///< N m s or N s
    double upper = 0.0;
    double softness = 0.0;  ///< velocity error allowed per impulse; 0: hard
  };

  /// `rows` fixes the links and coefficients; the other fields are set before each step. `body`
  /// must be finalised and have a collider on Bullet link 0: Bullet finds the island through it,
  /// and silently skips constraints without one.
  JointRows(btMultiBody* body, std::vector<Row> rows);

  Row& row(int i) { return rows_[i]; }
  /// Impulse that the last step applied in a row, N m s or N s.
  double impulse(int i) const { return m_data[i]; }

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& constraint_rows,
                            btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  std::vector<Row> rows_;
};

}  // namespace pedicel::robot
